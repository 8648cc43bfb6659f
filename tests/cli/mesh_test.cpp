#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {

namespace {

using Json = nlohmann::json;

class MeshRun : public ProgramTest {
 protected:
  Json report(const std::vector<std::string>& options = {}) const {
    std::vector<std::string> arguments{"mesh",       lake(), "-o", file("report.2dm"), "--report", file("report.json"),
                                       "--overwrite"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    return Json::parse(readText(file("report.json")));
  }
};

std::set<std::string> keysOf(const Json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.items()) keys.insert(item.key());
  return keys;
}

TEST_F(MeshRun, WritesEveryOutputAndNothingElse) {
  const std::string input = lake();
  const ProgramRun run = runProgram({"mesh", input, "-o", file("a.2dm"), "-o", file("a.msh"), "-o", file("a.nc"), "-o",
                                     file("a.gpkg"), "-o", file("a.vtu"), "--report", file("a.json")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(run.errors, "");
  EXPECT_NE(run.output.find("Steiner points"), std::string::npos) << run.output;
  // Formats that cannot hold a CRS get a .prj.
  EXPECT_EQ(names(),
            (std::set<std::string>{"lake.geojson", "a.2dm", "a.prj", "a.msh", "a.nc", "a.gpkg", "a.vtu", "a.json"}));
}

TEST_F(MeshRun, QuietPrintsNothing) {
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("a.2dm"), "--quiet"});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.output + run.errors, "");
}

TEST_F(MeshRun, FormatIsTakenWhereTheEndingDoesNotTell) {
  EXPECT_EQ(runProgram({"mesh", lake(), "-o", file("grid.dat"), "--format", "2dm"}).code, 0);
  EXPECT_TRUE(readText(file("grid.dat")).starts_with("MESH2D"));
}

TEST_F(MeshRun, ReportHasItsKeys) {
  const Json json = report();
  EXPECT_EQ(keysOf(json),
            (std::set<std::string>{"coastmesh", "input",      "clean",           "refine",          "mesh",
                                   "depth",     "attributes", "boundaries",      "lines",           "step",
                                   "repairs",   "partition",  "output_warnings", "warnings",        "time_s",
                                   "parallel",  "cluster",    "checkpoint",      "peak_memory_mib", "threads"}));
  EXPECT_EQ(keysOf(json["parallel"]),
            (std::set<std::string>{"work_s", "critical_path_s", "speedup", "meshing", "stages"}));
  EXPECT_EQ(keysOf(json["parallel"]["speedup"]), (std::set<std::string>{"2", "8", "64"}));
  const Json& stages = json["parallel"]["stages"];
  ASSERT_FALSE(stages.empty());
  for (std::size_t i = 1; i < stages.size(); ++i)
    EXPECT_TRUE(stages[i]["name"] != stages[i - 1]["name"] || stages[i].contains("item_s")) << stages[i];
  EXPECT_EQ(keysOf(json["input"]),
            (std::set<std::string>{"files", "features", "rings", "points", "skipped_empty", "skipped_points", "crs",
                                   "projection", "projection_reason", "scale", "projections", "area_m2", "refused",
                                   "filtered", "beyond_frame", "notes", "warnings"}));
  EXPECT_EQ(keysOf(json["refine"]), (std::set<std::string>{"algorithm",
                                                           "min_angle_deg",
                                                           "max_angle_deg",
                                                           "size_max_m",
                                                           "sized",
                                                           "grade",
                                                           "estimated_vertices",
                                                           "coarsen",
                                                           "shrink",
                                                           "smooth",
                                                           "quality",
                                                           "steiner_points",
                                                           "by_type",
                                                           "segment_splits",
                                                           "relocations",
                                                           "removals",
                                                           "merges",
                                                           "regions",
                                                           "budget_reached",
                                                           "unresolved"}));
  EXPECT_EQ(keysOf(json["refine"]["by_type"]), (std::set<std::string>{"I", "II", "III", "IV"}));
  EXPECT_EQ(keysOf(json["refine"]["unresolved"]), (std::set<std::string>{"count", "places"}));
  EXPECT_EQ(keysOf(json["mesh"]),
            (std::set<std::string>{"vertices", "triangles", "surface", "closed", "euler", "area_m2", "min_angle_deg",
                                   "max_angle_deg", "below_bound", "below_bound_explained", "excused", "unresolved",
                                   "angle_histogram", "turned", "digest"}));
  EXPECT_EQ(keysOf(json["time_s"]),
            (std::set<std::string>{"read", "clean", "size", "triangulate", "refine", "coarsen", "shrink", "optimise",
                                   "fit", "stitch", "check", "finish", "write", "total"}));
}

TEST_F(MeshRun, ReportAgreesWithItself) {
  const Json json = report({"--min-angle", "30"});
  EXPECT_EQ(json["input"]["features"], 1);
  EXPECT_EQ(json["input"]["rings"], 2);
  EXPECT_EQ(json["refine"]["regions"], 1);
  EXPECT_EQ(json["refine"]["min_angle_deg"], 30.0);
  EXPECT_EQ(json["mesh"]["vertices"].get<int>(), 10 + json["refine"]["steiner_points"].get<int>());
  EXPECT_GE(json["mesh"]["min_angle_deg"].get<double>(), 30.0 - 1e-6);
  EXPECT_EQ(json["mesh"]["angle_histogram"].size(), 36u);
  int angles = 0;
  for (const Json& count : json["mesh"]["angle_histogram"]) angles += count.get<int>();
  EXPECT_EQ(angles, 3 * json["mesh"]["triangles"].get<int>());
  const double area = json["input"]["area_m2"].get<double>();
  EXPECT_NEAR(json["mesh"]["area_m2"].get<double>() / area, 1.0, 1e-6);
}

// A needle of 10 degrees, and a strip that no mesh of so few vertices can fill well.
TEST_F(MeshRun, TrianglesThatBreakTheBoundsAreCountedByWhatExcusesThem) {
  const std::string needle = write("needle.geojson", geoJsonPolygons({{{{0, 0}, {0.1, 0}, {0.1, 0.0176}}}}));
  const auto counts = [&](const std::string& input, const std::string& budget) {
    const ProgramRun run = runProgram({"mesh", input, "-o", file("m.nc"), "--overwrite", "--max-vertices", budget,
                                       "--min-angle", "30", "--report", file("m.json")});
    const Json mesh = Json::parse(readText(file("m.json")))["mesh"];
    const int below = mesh["below_bound"], corner = mesh["excused"]["corner"], near = mesh["excused"]["near"];
    EXPECT_EQ(mesh["unresolved"], below - corner - near);
    EXPECT_EQ(mesh["below_bound_explained"], corner + near);
    const std::string text = std::to_string(below) + (below == 1 ? " triangle breaks" : " triangles break") +
                             " the bounds on angles: " + std::to_string(corner) +
                             " in input angles too small for them, " + std::to_string(near) +
                             " near to such an angle, " + std::to_string(below - corner - near) + " unresolved\n";
    EXPECT_NE(run.output.find(text), std::string::npos) << run.output;
    const ProgramRun check = runProgram({"check", file("m.nc"), "--input", input, "--min-angle", "30"});
    EXPECT_EQ(check.output.find(text) != std::string::npos, corner + near > 0) << check.output;
    EXPECT_EQ(check.code, run.code);
    return std::array{below, corner, near};
  };
  EXPECT_EQ(counts(needle, "1000"), (std::array{1, 1, 0}));
  const std::string strip = write("strip.geojson", geoJsonPolygons({{{{0, 0}, {0.1, 0}, {0.1, 0.0005}, {0, 0.0005}}}}));
  const auto [below, corner, near] = counts(strip, "10");
  EXPECT_GT(below, 0);
  EXPECT_EQ(corner + near, 0);
}

TEST_F(MeshRun, SizeBoundIsInMetres) {
  const Json json = report({"--size-max", "100"});
  const double area = json["mesh"]["area_m2"].get<double>();
  // A triangle with edges of at most 100 m is no larger than the equilateral one.
  EXPECT_GE(json["mesh"]["triangles"].get<double>(), area / (0.4331 * 100 * 100));
  const Json info = Json::parse(runProgram({"info", file("report.2dm"), "--assume-crs", "EPSG:4326", "--json"}).output);
  EXPECT_LE(info["longest_edge_m"].get<double>(), 100.0 * 1.001);
}

TEST_F(MeshRun, SizesAreInMetres) {
  const Json json = report({"--size", "100"});
  const double needed = json["mesh"]["area_m2"].get<double>() * 2.0 / (std::sqrt(3.0) * 100.0 * 100.0);
  EXPECT_NEAR(json["mesh"]["vertices"].get<double>() / needed, 1.05, 0.15);
  EXPECT_TRUE(json["refine"]["sized"].get<bool>());
}

TEST_F(MeshRun, AFileCanHoldTheWholeJob) {
  write("job.toml", "input = \"" + lake() + "\"\noutput = [\"" + file("a.2dm") + "\"]\nsize = 100\nquiet = true\n");
  EXPECT_EQ(runProgram({"mesh", "--config", file("job.toml")}).code, 0);
  EXPECT_EQ(runProgram({"mesh", lake(), "-o", file("b.2dm"), "--size", "100"}).code, 0);
  EXPECT_EQ(readText(file("a.2dm")), readText(file("b.2dm")));
  write("bad.toml", "sise = 100\n");
  const ProgramRun run = runProgram({"mesh", "--config", file("bad.toml")});
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.errors.find("'sise'"), std::string::npos);
  const std::string turned = write("turned.toml", "size = -1\n");
  const ProgramRun negative = runProgram({"mesh", lake(), "-o", file("c.2dm"), "--config", turned});
  EXPECT_EQ(negative.code, 2);
  EXPECT_NE(negative.errors.find("'" + turned + "': 'size': '-1' is not a number"), std::string::npos)
      << negative.errors;
  write("half.toml", "input = \"" + lake() + "\"\n");
  const ProgramRun half = runProgram({"mesh", "--config", file("half.toml")});
  EXPECT_EQ(half.code, 2);
  EXPECT_NE(half.errors.find("--output is required"), std::string::npos) << half.errors;
}

TEST_F(MeshRun, SizesThatDoNotGoTogetherAreRefused) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--wave-elements", "100"},
                                             {"--size-min", "10", "--size-max", "5"},
                                             {"--channel-elements", "3"},
                                             {"--depth-band", "1,2"},
                                             {"--coast", "follow"},
                                             {"--time-step", "5"}}) {
    std::vector<std::string> arguments{"mesh", lake(), "-o", file("a.2dm")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(runProgram(arguments).code, 2) << options[0];
  }
}

TEST_F(MeshRun, ThreadsChangeNothing) {
  const std::string input =
      write("parts.geojson", geoJsonPolygons({{{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}},
                                              {{{1, 0}, {1.1, 0}, {1.1, 0.1}, {1.03, 0.13}}},
                                              {{{2, 50}, {2.1, 50}, {2.1, 50.1}, {2.03, 50.2}, {2.0, 50.1}}}}));
  std::set<std::string> digests;
  std::set<std::string> bytes;
  for (const char* threads : {"1", "2", "3"}) {
    const ProgramRun run = runProgram({"mesh", input, "-o", file("a.gpkg"), "-o", file("a.2dm"), "--report",
                                       file("a.json"), "--threads", threads, "--overwrite", "--min-angle", "36"});
    EXPECT_EQ(run.code, 0) << run.errors;
    const Json json = Json::parse(readText(file("a.json")));
    EXPECT_EQ(json["refine"]["regions"], 3);
    EXPECT_EQ(json["threads"], std::stoi(threads));
    digests.insert(json["mesh"]["digest"].get<std::string>());
    bytes.insert(readText(file("a.gpkg")) + readText(file("a.2dm")));
  }
  EXPECT_EQ(digests.size(), 1u);
  EXPECT_EQ(bytes.size(), 1u);
}

TEST_F(MeshRun, OptionsChangeTheMesh) {
  const std::string plain = report()["mesh"]["digest"];
  EXPECT_NE(report({"--min-angle", "38"})["mesh"]["digest"], plain);
  EXPECT_NE(report({"--size-max", "200"})["mesh"]["digest"], plain);
  EXPECT_NE(report({"--algorithm", "circumcenter", "--no-coarsen"})["mesh"]["digest"], plain);
}

// Former names are accepted for one version, for existing scripts and files.
TEST_F(MeshRun, FormerNamesOfOptionsAndKeysAreTakenWithAWarning) {
  const auto warning = [](const std::string& former, const std::string& present) {
    return former + " is called " + present + " now; the next version will not accept the former name";
  };
  const Json present = report({"--no-coarsen"}), plain = report();
  EXPECT_TRUE(present["warnings"].empty());
  ASSERT_NE(present["mesh"]["digest"], plain["mesh"]["digest"]);
  const std::string config = write("former.toml", "shrink = false\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> formers = {
      {{"--no-shrink"}, warning("--no-shrink", "--no-coarsen")},
      {{"--config", config}, "'" + config + "': " + warning("'shrink'", "'coarsen'")}};
  for (const auto& [former, sentence] : formers) {
    const Json taken = report(former);
    EXPECT_EQ(taken["mesh"]["digest"], present["mesh"]["digest"]);
    EXPECT_EQ(taken["warnings"], Json::array({sentence}));
    EXPECT_EQ(taken["refine"]["coarsen"], false);
  }
  const Json on = report({"--shrink", "--algorithm", "circumcenter"});
  EXPECT_EQ(on["warnings"], Json::array({warning("--shrink", "--coarsen")}));
  EXPECT_EQ(on["mesh"]["digest"], report({"--coarsen", "--algorithm", "circumcenter"})["mesh"]["digest"]);
  for (const Json& json : {present, plain, on}) {
    EXPECT_EQ(json["refine"]["shrink"], json["refine"]["coarsen"]);
    EXPECT_EQ(json["time_s"]["shrink"], json["time_s"]["coarsen"]);
    EXPECT_EQ(json["time_s"]["fit"], json["time_s"]["optimise"]);
  }
  const Json boundaries = report({"--min-boundary", "1"})["boundaries"];
  EXPECT_EQ(boundaries["edges_by_file"], 0);
  EXPECT_EQ(boundaries["edges_told"], 0);
}

TEST_F(MeshRun, PolyIsMeshedInThePlane) {
  const std::string input = write("square.poly",
                                  "8 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n5 1 1\n6 3 1\n7 3 3\n8 1 3\n"
                                  "8 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n1\n1 2 2\n");
  const ProgramRun run = runProgram({"mesh", input, "-o", file("a.2dm"), "--report", file("a.json")});
  EXPECT_EQ(run.code, 0) << run.errors;
  const Json json = Json::parse(readText(file("a.json")));
  EXPECT_NEAR(json["mesh"]["area_m2"].get<double>(), 12.0, 1e-9);
  EXPECT_TRUE(json["input"]["area_m2"].is_null());
  EXPECT_EQ(runProgram({"check", file("a.2dm"), "--input", input, "--min-angle", "33"}).code, 0);
}

TEST_F(MeshRun, ProgressIsJsonLines) {
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("a.2dm"), "--progress", "json"});
  EXPECT_EQ(run.code, 0) << run.errors;
  std::istringstream lines(run.output);
  std::string line;
  std::set<std::string> phases;
  std::string last;
  double share = 0.0;
  while (std::getline(lines, line)) {
    const Json json = Json::parse(line);
    EXPECT_EQ(keysOf(json), (std::set<std::string>{"phase", "share"}));
    if (json["phase"] != last) share = 0.0;
    EXPECT_GE(json["share"].get<double>(), share);
    EXPECT_LE(json["share"].get<double>(), 1.0);
    share = json["share"];
    last = json["phase"];
    phases.insert(last);
  }
  EXPECT_EQ(phases, (std::set<std::string>{"read", "refine", "write", "done"}));
  EXPECT_EQ(last, "done");
}

// A polygon inside another one is no island; if there are many, only some are named.
TEST_F(MeshRun, PolygonsInPolygonsAreWarnedOf) {
  std::vector<std::vector<LonLatRing>> polygons;
  for (const double lon : {0, 1, 2, 3, 4})
    for (const double lat : {0, 1, 2, 3, 4}) {
      polygons.push_back({{{lon, lat}, {lon + 0.5, lat}, {lon + 0.5, lat + 0.5}, {lon, lat + 0.5}}});
      polygons.push_back({{{lon + 0.2, lat + 0.2}, {lon + 0.3, lat + 0.2}, {lon + 0.3, lat + 0.3}}});
    }
  const std::string input = write("lakes.geojson", geoJsonPolygons(polygons));
  const ProgramRun run = runProgram({"mesh", input, "-o", file("a.2dm"), "--report", file("a.json")});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_NE(run.output.find("mended in the input: features overlap 25; --edits FILE has the places"), std::string::npos)
      << run.output;
  const Json warnings = Json::parse(readText(file("a.json")))["warnings"];
  ASSERT_EQ(warnings.size(), 21u);
  const std::string first = warnings.front(), last = warnings.back();
  EXPECT_NE(first.find("feature 1 lies in "), std::string::npos) << first;
  EXPECT_EQ(last, "5 more warnings of other features are not shown");
}

// Features of different files may have the same number.
TEST_F(MeshRun, EditsNameTheSourceOfTheirFeature) {
  const auto bowTie = [&](const std::string& name, double lon) {
    return write(name, geoJsonPolygons({{{{lon, 0}, {lon + 0.4, 0.4}, {lon + 0.4, 0}, {lon, 0.4}}}}));
  };
  const std::string west = bowTie("west.geojson", 0), east = bowTie("east.geojson", 1);
  ASSERT_EQ(runProgram({"mesh", west, east, "-o", file("a.2dm"), "--edits", file("edits.geojson"), "--quiet"}).code, 0);
  ASSERT_EQ(runProgram({"clean", west, east, "-o", file("cleaned.gpkg"), "--quiet"}).code, 0);
  ASSERT_EQ(
      runProgram({"mesh", file("cleaned.gpkg"), "-o", file("b.2dm"), "--edits", file("again.geojson"), "--quiet"}).code,
      0);
  for (const std::string layer : {"edits.geojson", "again.geojson"}) {
    const Json edits = Json::parse(readText(file(layer)))["features"];
    ASSERT_EQ(edits.size(), 2u) << layer;
    for (const Json& edit : edits) {
      const double lon = edit["geometry"]["coordinates"][0];
      EXPECT_EQ(edit["properties"]["kind"], "self-crossing");
      EXPECT_EQ(edit["properties"]["source"], lon < 1 ? west : east);
    }
  }
}

TEST_F(MeshRun, AFilterThatHoldsForNothingIsNamed) {
  const ProgramRun run = runProgram({"mesh", lake(), "--where", "fid = 77", "-o", file("a.2dm")});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.errors.find("--where \"fid = 77\" holds for no feature"), std::string::npos) << run.errors;
}

TEST_F(MeshRun, AllRefusedStillReports) {
  const std::string input = write("flat.geojson", geoJsonPolygons({{{{0, 0}, {1, 0}, {2, 0}}}}));
  EXPECT_EQ(runProgram({"mesh", input, "-o", file("a.2dm"), "--report", file("a.json")}).code, 3);
  const Json json = Json::parse(readText(file("a.json")));
  ASSERT_EQ(json["input"]["refused"].size(), 1u);
  EXPECT_EQ(json["input"]["refused"][0]["fids"], Json::array({0}));
  EXPECT_EQ(json["mesh"]["triangles"], 0);
  EXPECT_EQ(names(), (std::set<std::string>{"flat.geojson", "a.json"}));
}

}  // namespace

}  // namespace coastmesh::test
