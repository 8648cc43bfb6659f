#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

class CoastFollow : public ProgramTest {
 protected:
  // Meshes the sea in a box of 1 by 1 degree, with the given land, and returns the report.
  nlohmann::json sea(const std::vector<std::vector<LonLatRing>>& land, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"mesh",        write("land.geojson", geoJsonPolygons(land)),
                                       "-o",          file("sea.2dm"),
                                       "--overwrite", "--domain",
                                       "outside",     "--bbox=0,0,1,1",
                                       "--coast",     "follow",
                                       "--report",    file("report.json")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    run_ = runProgram(arguments);
    EXPECT_EQ(run_.code, 0) << run_.errors;
    return nlohmann::json::parse(readText(file("report.json")));
  }

  ProgramRun run_;
};

const LonLatRing kCoast{{-0.1, -0.1}, {1.1, -0.1}, {1.1, 0.05}, {-0.1, 0.05}};

TEST_F(CoastFollow, WhatIsDroppedLeavesNoFineElementsBehind) {
  const LonLatRing islet{{0.5, 0.6}, {0.502, 0.6}, {0.502, 0.602}, {0.5, 0.602}};
  const std::vector<std::string> sizes{"--size-shore", "1000", "--shore-rate", "0.2",
                                       "--grade",      "0.2",  "--size-max",   "20000"};
  const auto vertices = [](const nlohmann::json& report) { return report["mesh"]["vertices"].get<int>(); };
  const int without = vertices(sea({{kCoast}}, sizes));
  const nlohmann::json with = sea({{kCoast}, {islet}}, sizes);
  EXPECT_EQ(with["clean"]["small_island"], 1);
  EXPECT_NEAR(vertices(with), without, 0.03 * without);
}

// An island 33 km long beside the coast, a strait of 500 m between them, and a line through the strait.
TEST_F(CoastFollow, StraitsAreNamedAndPassagesKeepThemOpen) {
  const LonLatRing island{{0.3, 0.0545}, {0.6, 0.0545}, {0.6, 0.15}, {0.3, 0.15}};
  const std::vector<std::string> sizes{"--size-shore", "2000", "--grade", "0.2", "--size-max", "20000"};
  const auto hasNote = [](const nlohmann::json& report, const std::string& text) {
    for (const auto& note : report["input"]["notes"])
      if (note.get<std::string>().find(text) != std::string::npos) return true;
    return false;
  };
  const nlohmann::json closed = sea({{kCoast}, {island}}, sizes);
  EXPECT_EQ(closed["boundaries"]["island"], 0);
  EXPECT_TRUE(hasNote(closed, "straits closed, the longest of 1: (0.4")) << closed["input"]["notes"];
  EXPECT_NE(run_.output.find("--passages"), std::string::npos) << run_.output;

  write("passage.geojson",
        R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"name": "narrows"}, "geometry":
        {"type": "LineString", "coordinates": [[0.25, 0.06], [0.3, 0.0522], [0.6, 0.0522], [0.65, 0.06]]}}]})");
  std::vector<std::string> with = sizes;
  with.insert(with.end(), {"--passages", file("passage.geojson")});
  const nlohmann::json open = sea({{kCoast}, {island}}, with);
  EXPECT_EQ(open["boundaries"]["island"], 1);
  EXPECT_EQ(open["clean"]["widened_passage"], 1);
  EXPECT_TRUE(hasNote(open, "passage 'narrows' was widened to 2")) << open["input"]["notes"];
  EXPECT_FALSE(hasNote(open, "straits closed")) << open["input"]["notes"];

  with.insert(with.end(), {"--barriers", file("passage.geojson")});
  EXPECT_EQ(sea({{kCoast}, {island}}, with)["boundaries"]["island"], 0);
}

// A lagoon behind the coast without a connection to the sea: it is a defect if kept; for a model it is left out by
// default.
TEST_F(CoastFollow, WaterThatNothingJoinsToAnOpenBoundaryIsADefect) {
  const std::vector<std::string> sizes{"--size",
                                       "3000",
                                       "--target",
                                       "adcirc",
                                       "-o",
                                       file("fort.14"),
                                       "--bathymetry",
                                       write("depths.asc",
                                             "ncols 2\nnrows 2\nxllcorner -1\nyllcorner -1\ncellsize 2\n"
                                             "-20 -20\n-20 -20\n")};
  const LonLatRing shore{{-0.1, -0.1}, {1.1, -0.1}, {1.1, 0.4}, {-0.1, 0.4}};
  const LonLatRing lagoon{{0.3, 0.1}, {0.3, 0.3}, {0.7, 0.3}, {0.7, 0.1}};
  for (const bool all : {true, false}) {
    std::vector<std::string> options = sizes;
    options.insert(options.end(), {"--keep-water", all ? "all" : "auto"});
    const nlohmann::json report = sea({{shore, lagoon}}, options);
    // The lagoon is 0.08 of 0.68 square degrees, more than a few percent.
    EXPECT_EQ(report["warnings"].dump().find("(12 %) of the water is left out") != std::string::npos, !all)
        << report["warnings"];
    EXPECT_EQ(run_.errors.find("without a connection in the data") != std::string::npos, !all) << run_.errors;
    const ProgramRun check = runProgram({"check", file("fort.14"), "--target", "adcirc"});
    EXPECT_EQ(check.code, all ? 1 : 0) << check.output;
    EXPECT_EQ(check.output.find("water apart") != std::string::npos, all) << check.output;
  }
}

// The report is of the water that is written.
TEST_F(CoastFollow, ALakeThatIsLeftOutForAModelDoesNotCount) {
  const LonLatRing sea{{0, 50}, {0.3, 50}, {0.3, 50.3}, {0, 50.3}};
  const LonLatRing lake{{0.5, 50.05}, {0.7, 50.05}, {0.7, 50.25}, {0.5, 50.25}};
  const std::string input = write("waters.geojson", geoJsonPolygons({{sea}, {lake}}));
  const std::string out = file("waters.2dm");
  const ProgramRun run = runProgram({"mesh", input, "--bbox=0.1,49,2,51", "--size", "2000", "--coast", "follow",
                                     "--target", "adcirc", "-o", out, "--report", file("r.json")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_NE(run.errors.find("of the water is left out"), std::string::npos) << run.errors;
  const nlohmann::json report = nlohmann::json::parse(readText(file("r.json")));
  const double area = report["mesh"]["area_m2"].get<double>();
  EXPECT_NEAR(report["input"]["area_m2"].get<double>() / area, 1.0, 0.01);
  EXPECT_GT(report["refine"]["steiner_points"].get<int>(), 0);
  EXPECT_LT(report["refine"]["steiner_points"].get<int>(), report["mesh"]["vertices"].get<int>());
}

// Half of a small lake is cut off: a third of a percent of all water.
TEST_F(CoastFollow, WhatIsLeftOutIsAShareOfAllWaters) {
  const LonLatRing large{{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const LonLatRing two{{1, 0},       {1.03, 0},    {1.03, 0.0149}, {1.05, 0.0149}, {1.05, 0},    {1.08, 0},
                       {1.08, 0.03}, {1.05, 0.03}, {1.05, 0.0151}, {1.03, 0.0151}, {1.03, 0.03}, {1, 0.03}};
  const std::string lakes = write("lakes.geojson", geoJsonPolygons({{large}, {two}}));
  const ProgramRun run = runProgram(
      {"mesh", lakes, "-o", file("lakes.nc"), "--size", "1000", "--coast", "follow", "--keep-water", "largest"});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.errors, "");
  EXPECT_NE(run.output.find("(0.36 %) of the water is left out, 1 water"), std::string::npos) << run.output;
}

// The same lakes, taken as they are: square degrees of square degrees.
TEST_F(CoastFollow, InAPlaneOfDegreesSharesAreOfItsUnits) {
  const LonLatRing large{{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const LonLatRing two{{1, 0},       {1.03, 0},    {1.03, 0.0149}, {1.05, 0.0149}, {1.05, 0},    {1.08, 0},
                       {1.08, 0.03}, {1.05, 0.03}, {1.05, 0.0151}, {1.03, 0.0151}, {1.03, 0.03}, {1, 0.03}};
  const std::string lakes = write("lakes.geojson", geoJsonPolygons({{large}, {two}}));
  const ProgramRun run = runProgram({"mesh", lakes, "-o", file("lakes.2dm"), "--size", "0.01", "--coast", "follow",
                                     "--keep-water", "largest", "--crs", "plane"});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.output.find("0.0009 (0.36 %) of the water is left out, 1 water"), std::string::npos) << run.output;
  EXPECT_EQ(run.errors.find("area than in the input"), std::string::npos) << run.errors;
}

// A strait of 11 km between two coasts, with elements of 3 km and of 30 km.
TEST_F(CoastFollow, WaterThatSizesAreTooLargeForIsWarnedOf) {
  const LonLatRing south{{-0.1, -0.1}, {1.1, -0.1}, {1.1, 0.1}, {0.4, 0.1}, {0.4, 0.45}, {-0.1, 0.45}};
  const LonLatRing north{{-0.1, 0.55}, {0.4, 0.55}, {0.4, 0.9}, {1.1, 0.9}, {1.1, 1.1}, {-0.1, 1.1}};
  sea({{south}, {north}}, {"--size", "3000"});
  EXPECT_EQ(run_.errors, "");
  const nlohmann::json report = sea({{south}, {north}}, {"--size", "30000"});
  EXPECT_NE(
      run_.errors.find(" %) less area than in the input: water narrower than an element is closed; smaller sizes"),
      std::string::npos)
      << run_.errors;
  EXPECT_LT(report["mesh"]["area_m2"].get<double>(), 0.98 * report["input"]["area_m2"].get<double>());
}

// An island of 5 hectares is removed; the layer has this edit and its place.
TEST_F(CoastFollow, EditsAreALayer) {
  const LonLatRing islet{{0.5, 0.6}, {0.502, 0.6}, {0.502, 0.602}, {0.5, 0.602}};
  const nlohmann::json report =
      sea({{kCoast}, {islet}}, {"--size-shore", "1000", "--grade", "0.2", "--edits", file("edits.geojson")});
  std::map<std::string, std::uint64_t> counts;
  const nlohmann::json layer = nlohmann::json::parse(readText(file("edits.geojson")));
  for (const nlohmann::json& edit : layer["features"]) {
    ++counts[edit["properties"]["kind"]];
    if (edit["properties"]["kind"] != "small island") continue;
    EXPECT_NEAR(edit["geometry"]["coordinates"][0].get<double>(), 0.501, 0.0011);
    EXPECT_NEAR(edit["geometry"]["coordinates"][1].get<double>(), 0.601, 0.0011);
  }
  EXPECT_EQ(counts["small island"], 1u);
  for (const auto& [kind, count] : counts) {
    std::string key = kind;
    std::ranges::replace(key, ' ', '_');
    EXPECT_EQ(report["clean"][key].get<std::uint64_t>(), count) << kind;
  }
}

TEST_F(CoastFollow, GuidesWithoutLinesAreRefused) {
  const std::string polygons = write("polygons.geojson", geoJsonPolygons({{kCoast}}));
  const ProgramRun run =
      runProgram({"mesh", lake(), "-o", file("a.2dm"), "--size", "100", "--coast", "follow", "--passages", polygons});
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
  EXPECT_NE(run.errors.find("holds no lines"), std::string::npos) << run.errors;
}

}  // namespace
}  // namespace coastmesh::test
