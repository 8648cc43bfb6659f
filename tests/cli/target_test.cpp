// Outputs after repairs for models.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using Target = ProgramTest;
using Json = nlohmann::json;

// The sizes of nodes, by position, in a layer written by the program.
std::map<std::pair<double, double>, double> sizesIn(const std::string& path) {
  std::map<std::pair<double, double>, double> sizes;
  const Json layer = Json::parse(readText(path));
  for (const Json& feature : layer.at("features")) {
    const Json& place = feature.at("geometry").at("coordinates");
    sizes[{place.at(0), place.at(1)}] = feature.at("properties").at("size");
  }
  return sizes;
}

// A fort.14 file, without code of the library.
struct Fort14 {
  std::vector<std::array<double, 2>> nodes;
  std::vector<std::array<std::size_t, 3>> triangles;
};

Fort14 readFort14(const std::string& path) {
  std::istringstream text(readText(path));
  std::string title;
  std::getline(text, title);
  std::size_t triangles = 0, nodes = 0, number = 0, corners = 0;
  double depth = 0.0;
  text >> triangles >> nodes;
  Fort14 grid;
  grid.nodes.resize(nodes);
  grid.triangles.resize(triangles);
  for (auto& [x, y] : grid.nodes) text >> number >> x >> y >> depth;
  for (auto& [a, b, c] : grid.triangles) {
    text >> number >> corners >> a >> b >> c;
    --a, --b, --c;
  }
  EXPECT_TRUE(text.good()) << path;
  return grid;
}

// Angles that SWAN refuses: it takes coordinates as they are and stops if a cosine is -0.8 or less.
std::size_t refusedBySwan(const Fort14& grid) {
  const auto squareOf = [&](std::size_t a, std::size_t b) {
    const double dx = grid.nodes[a][0] - grid.nodes[b][0], dy = grid.nodes[a][1] - grid.nodes[b][1];
    return dx * dx + dy * dy;
  };
  std::size_t refused = 0;
  for (const auto& v : grid.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double before = squareOf(v[i], v[(i + 1) % 3]), after = squareOf(v[i], v[(i + 2) % 3]);
      const double across = squareOf(v[(i + 1) % 3], v[(i + 2) % 3]);
      refused += (before + after - across) / (2.0 * std::sqrt(before * after)) <= -0.8;
    }
  }
  return refused;
}

// A lake some 130 km across, where a degree of longitude is a quarter as long as a degree of latitude.
TEST_F(Target, SwanGetsNoLargeAngleInTheDegreesOfItsFile) {
  LonLatRing ring;
  for (int k = 0; k < 120; ++k) {
    const double turn = 2.0 * M_PI * k / 120, reach = 0.5 * (1.0 + 0.2 * std::sin(5.0 * turn));
    ring.emplace_back(10.0 + 4.0 * reach * std::cos(turn), 75.0 + reach * std::sin(turn));
  }
  ring.push_back(ring.front());
  const std::string input = write("lake.geojson", geoJsonPolygons({{ring}}));
  const std::vector<std::string> plain{"mesh", input, "--size", "3000", "-o", file("plain.14")};
  ASSERT_EQ(runProgram(plain).code, 0);
  EXPECT_GT(refusedBySwan(readFort14(file("plain.14"))), 0u);
  EXPECT_EQ(runProgram({"check", file("plain.14"), "--target", "swan"}).code, 1);
  // Repairs keep the angle bound too; the size is a target, not a bound.
  const std::vector<std::string> mended{"mesh", input,      "--size", "3000", "--min-angle",
                                        "15",   "--target", "swan",   "-o",   file("swan.14")};
  const ProgramRun run = runProgram(mended);
  EXPECT_EQ(run.code, 0) << run.errors;
  const Fort14 grid = readFort14(file("swan.14"));
  EXPECT_GT(grid.triangles.size(), 2000u);
  EXPECT_EQ(refusedBySwan(grid), 0u);
  EXPECT_EQ(runProgram({"check", file("swan.14"), "--target", "swan"}).code, 0);
}

// The time step of long waves means nothing to models without them.
TEST_F(Target, OnlyModelsOfLongWavesAreToldTheirTimeStep) {
  const std::string bed = write("bed.asc", "ncols 1\nnrows 1\nxllcorner -88\nyllcorner 41\ncellsize 1\n-9\n");
  const auto told = [&](const std::vector<std::string>& targets) {
    std::vector<std::string> all{"mesh", lake(), "--size-max", "250",        "--bathymetry",
                                 bed,    "-o",   file("a.nc"), "--overwrite"};
    for (const std::string& target : targets) all.insert(all.end(), {"--target", target});
    const ProgramRun run = runProgram(all);
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_THAT(run.output, ::testing::HasSubstr("shortest edge "));
    return run.output.find("time step by CFL") != std::string::npos;
  };
  EXPECT_TRUE(told({}));
  EXPECT_TRUE(told({"schism"}));
  EXPECT_TRUE(told({"swan", "adcirc"}));
  EXPECT_FALSE(told({"swan"}));
}

// A box across the antimeridian with an island: if longitudes jumped, SWAN would see triangles around the globe.
TEST_F(Target, LongitudesGoOnPastTheAntimeridian) {
  const std::string input =
      write("land.geojson", geoJsonPolygons({{{{179.4, -17.1}, {179.7, -17.1}, {179.7, -16.8}, {179.4, -16.8}}}}));
  const ProgramRun run = runProgram({"mesh", input, "--domain", "outside", "--bbox=179,-17.5,-179,-16.5", "--size",
                                     "6000", "--target", "swan", "-o", file("f.14"), "-o", file("f.gpkg"), "-o",
                                     file("f.geojson"), "--report", file("report.json")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_TRUE(Json::parse(readText(file("report.json"))).at("repairs").at("done").empty());
  const Fort14 grid = readFort14(file("f.14"));
  EXPECT_GT(grid.triangles.size(), 500u);
  EXPECT_EQ(refusedBySwan(grid), 0u);
  const auto [west, east] = std::ranges::minmax(grid.nodes, {}, [](const auto& node) { return node[0]; });
  EXPECT_EQ(west[0], 179.0);
  EXPECT_EQ(east[0], 181.0);
  for (const auto& [place, size] : sizesIn(file("f_nodes.geojson"))) EXPECT_LE(std::abs(place.first), 180.0);
  // A layer is checked as it would be converted, a file as SWAN reads it.
  for (const char* mesh : {"f.14", "f.gpkg"})
    EXPECT_EQ(runProgram({"check", file(mesh), "--target", "swan"}).code, 0) << mesh;
  ASSERT_EQ(runProgram({"convert", file("f.gpkg"), "-o", file("again.14")}).code, 0);
  EXPECT_EQ(readText(file("again.14")), readText(file("f.14")));
  // Corners of the input are found 360 degrees away; with sizes, edges of the box are not those of the input.
  for (const char* mesh : {"f.14", "f.gpkg"}) {
    const ProgramRun check =
        runProgram({"check", file(mesh), "--input", input, "--domain", "outside", "--bbox=179,-17.5,-179,-16.5"});
    EXPECT_THAT(check.output, ::testing::Not(::testing::HasSubstr("input vertex missing"))) << mesh;
  }
  // Nodes at 181 get depths from a raster that begins at -180.
  const auto raster = [this](const char* name, const char* corner, const char* depth) {
    return write(name, std::string("ncols 2\nnrows 2\nxllcorner ") + corner + "\nyllcorner -18\ncellsize 1\n" + depth +
                           " " + depth + "\n" + depth + " " + depth + "\n");
  };
  ASSERT_EQ(runProgram({"convert", file("f.14"), "--bathymetry", raster("west.asc", "178", "-10"), "--bathymetry",
                        raster("east.asc", "-180", "-20"), "-o", file("deep.14")})
                .code,
            0);
  std::istringstream deep(readText(file("deep.14")));
  std::string line;
  std::getline(deep, line);
  std::getline(deep, line);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    double number = 0, x = 0, y = 0, depth = 0;
    deep >> number >> x >> y >> depth;
    if (std::abs(x - 180.0) < 1e-9) continue;  // in both rasters
    EXPECT_NEAR(depth, x < 180.0 ? 10.0 : 20.0, 1e-9) << x;
  }
}

// The number of triangles with an angle below `degrees`; coordinates are plane.
std::size_t sharperThan(double degrees, const Fort14& grid) {
  std::size_t sharp = 0;
  for (const auto& v : grid.triangles) {
    double least = 180.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &o = grid.nodes[v[i]], &p = grid.nodes[v[(i + 1) % 3]], &q = grid.nodes[v[(i + 2) % 3]];
      const double between = std::atan2(p[1] - o[1], p[0] - o[0]) - std::atan2(q[1] - o[1], q[0] - o[0]);
      least = std::min(least, std::abs(std::remainder(between, 2.0 * M_PI)) * 180.0 / M_PI);
    }
    sharp += least < degrees;
  }
  return sharp;
}

// A star without a corner below 60 degrees, so that every smaller angle is the mesh's own. Its mesh meets 42 degrees
// until a repair moves a node.
std::string starPoly() {
  const std::vector<std::array<int, 2>> ring{{1000, 0},  {866, 281},   {809, 588},   {526, 724},   {309, 951},
                                             {0, 758},   {-309, 951},  {-486, 670},  {-809, 588},  {-839, 273},
                                             {-1000, 0}, {-722, -235}, {-809, -588}, {-442, -608}, {-309, -951},
                                             {0, -842},  {309, -951},  {531, -731},  {809, -588},  {728, -237}};
  std::ostringstream star;
  star << ring.size() << " 2 0 0\n";
  for (std::size_t i = 0; i < ring.size(); ++i) star << i + 1 << ' ' << ring[i][0] << ' ' << ring[i][1] << '\n';
  star << ring.size() << " 0\n";
  for (std::size_t i = 0; i < ring.size(); ++i)
    star << i + 1 << ' ' << i + 1 << ' ' << (i + 1) % ring.size() + 1 << '\n';
  return star.str() + "0\n";
}

TEST_F(Target, WhatRepairsMakeOfTheBoundsIsWhatTheExitCodeSays) {
  const std::string input = write("star.poly", starPoly());
  const auto mesh = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(),
                {"mesh", input, "--min-angle", "42", "-o", file(out), "--overwrite", "--report", file("r.json")});
    const ProgramRun run = runProgram(more);
    const std::size_t sharp = sharperThan(42.0 - 1e-6, readFort14(file(out)));
    const Json report = Json::parse(readText(file("r.json")));
    EXPECT_EQ(report["refine"]["unresolved"]["count"], sharp);
    EXPECT_EQ(report["refine"]["unresolved"]["places"].size(), sharp);
    EXPECT_EQ(report["mesh"]["unresolved"], sharp);
    EXPECT_EQ(run.code, sharp == 0 ? 0 : 1) << run.errors;
    EXPECT_EQ(run.errors.find("repairs left triangles that miss") != std::string::npos, sharp > 0);
    EXPECT_EQ(runProgram({"check", file(out), "--min-angle", "42"}).code, run.code);
    return sharp;
  };
  EXPECT_EQ(mesh("plain.14", {}), 0u);
  EXPECT_GT(mesh("mended.14", {"--target", "dflowfm"}), 0u);
}

// All triangles are in one of the lines, with the smallest angle of what is written.
TEST_F(Target, FiguresOfAPartMeshedAnewAreThoseAfterRepairs) {
  const std::string input = write("star.poly", starPoly());
  ASSERT_EQ(runProgram({"mesh", input, "--min-angle", "42", "-o", file("whole.nc"), "--quiet"}).code, 0);
  std::size_t warned = 0;
  for (const std::string box : {"-1000,-1000,-500,1000", "500,-1000,1000,1000", "-1000,-1000,1000,-500"}) {
    const ProgramRun run = runProgram({"remesh", file("whole.nc"), "--bbox=" + box, "--size", "300", "--min-angle",
                                       "42", "--target", "dflowfm", "-o", file("part.14"), "--overwrite"});
    ASSERT_EQ(run.code, 0) << run.errors;
    std::size_t triangles = 0;
    double least = 180.0, least_repaired = 180.0;
    std::istringstream lines(run.output);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t at = line.find("angles from ");
      if (at == std::string::npos) continue;
      triangles += std::stoul(line.substr(line.find(": ") + 2));
      const double angle = std::stod(line.substr(at + 12));
      least = std::min(least, angle);
      if (line.starts_with("changed by repairs: ")) least_repaired = angle;
    }
    const Json info = Json::parse(runProgram({"info", file("part.14"), "--json"}).output);
    EXPECT_EQ(info["triangles"], triangles) << run.output;
    EXPECT_NEAR(info["min_angle_deg"].get<double>(), least, 0.051) << run.output;
    const bool is_warned = run.errors.find("the bounds on angles; the smallest angle is ") != std::string::npos;
    EXPECT_EQ(is_warned, least_repaired < 41.99) << run.output << run.errors;
    warned += is_warned;
  }
  EXPECT_GT(warned, 0U);
}

// A degree of longitude is a sixth of one of latitude there.
TEST_F(Target, SharpTrianglesOfSwanInDegreesAreExplained) {
  const std::string lake = write("lake.geojson", geoJsonPolygons({{{{10, 80}, {16, 80}, {16, 81}, {10, 81}}}}));
  const ProgramRun run = runProgram({"mesh", lake, "--size", "10000", "--target", "swan", "-o", file("lake.14")});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.errors.find("SWAN measures angles in the degrees of its file"), std::string::npos) << run.errors;
}

// Only the larger of two lakes gets an open boundary.
TEST_F(Target, WatersOfOtherFeaturesWithoutAnOpenBoundaryAreLeftOut) {
  const std::string lakes =
      write("lakes.geojson", geoJsonPolygons({{{{10, 50}, {10.2, 50}, {10.2, 50.1}, {10, 50.1}}},
                                              {{{11, 50}, {11.02, 50}, {11.02, 50.01}, {11, 50.01}}}}));
  const std::string west =
      write("west.geojson", R"({"type":"Feature","properties":{"type":"open"},"geometry":{"type":"LineString",)"
                            R"("coordinates":[[10,50],[10,50.1]]}})");
  const auto meshed = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"mesh",     lakes,          "--size",     "500", "--target",
                                       "schism",   "--boundaries", west,         "-o",  file("m.gr3"),
                                       "--report", file("m.json"), "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    return run.errors + readText(file("m.json"));
  };
  const auto defects = [&] { return runProgram({"check", file("m.gr3"), "--target", "schism"}).code; };
  const std::string left_out = "1 water of other features", stays = "1 water has no connection to an open boundary";
  const std::string followed = meshed({"--coast", "follow"});
  EXPECT_NE(followed.find(left_out), std::string::npos) << followed;
  EXPECT_EQ(followed.find(stays), std::string::npos) << followed;
  EXPECT_EQ(defects(), 0);
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, std::vector<std::string>{"--coast", "follow", "--keep-water", "all"}}) {
    const std::string kept = meshed(more);
    EXPECT_EQ(kept.find(left_out), std::string::npos) << kept;
    EXPECT_NE(kept.find(stays), std::string::npos) << kept;
    EXPECT_EQ(defects(), 1);
  }
}

// A box cuts a sea and a pond, whether they are features or parts of one.
TEST_F(Target, APondCutByTheFrameIsLeftOutHoweverTheInputIsDivided) {
  const std::string sea = "[[[0,0],[1,0],[1,1],[0,1],[0,0]]]",
                    pond = "[[[0.2,1.2],[0.3,1.2],[0.3,1.5],[0.2,1.5],[0.2,1.2]]]";
  const auto feature = [](const std::string& type, const std::string& coordinates) {
    return R"({"type":"Feature","properties":{},"geometry":{"type":")" + type + R"(","coordinates":)" + coordinates +
           "}}";
  };
  const std::string head = R"({"type":"FeatureCollection","features":[)";
  const std::string two = write("two.geojson", head + feature("Polygon", sea) + "," + feature("Polygon", pond) + "]}");
  const std::string one = write("one.geojson", head + feature("MultiPolygon", "[" + sea + "," + pond + "]") + "]}");
  const auto triangles = [&](const std::string& input, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"mesh",   input,        "--bbox=-0.5,0.5,0.9,1.4",
                                       "--size", "5000",       "--coast",
                                       "follow", "--target",   "adcirc",
                                       "-o",     file("m.14"), "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = runProgram(arguments);
    EXPECT_EQ(run.code, 0) << run.errors;
    EXPECT_EQ(run.errors.find("246 km² (4.3 %) of the water is left out") != std::string::npos, more.empty())
        << run.errors;
    return readFort14(file("m.14")).triangles.size();
  };
  EXPECT_EQ(triangles(two, {}), triangles(one, {}));
  EXPECT_GT(triangles(two, {"--keep-water", "open"}), triangles(two, {}));
}

// The two halves of a square have the same circumcentre: no water would flow across the diagonal.
TEST_F(Target, FlowLinksOfDflowfmHaveALength) {
  const std::string square =
      write("square.poly", "4 2 0 0\n1 0 0\n2 1000 0\n3 1000 1000\n4 0 1000\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  const std::string plain = file("plain.14"), mended = file("mended.14");
  ASSERT_EQ(runProgram({"mesh", square, "-o", plain}).code, 0);
  ASSERT_EQ(readFort14(plain).triangles.size(), 2u);
  EXPECT_EQ(runProgram({"check", plain, "--target", "dflowfm"}).code, 1);
  ASSERT_EQ(runProgram({"convert", plain, "--target", "dflowfm", "-o", mended}).code, 0);
  EXPECT_GT(readFort14(mended).triangles.size(), 2u);
  EXPECT_EQ(runProgram({"check", mended, "--target", "dflowfm"}).code, 0);
}

// Gaps of a tenth of a millimetre between features, filled with triangles that are flat except for the last bits.
TEST_F(Target, RepairsTurnNoTriangleOver) {
  const ProgramRun run =
      runProgram({"mesh", inputFile("target/narrow_gaps.geojson"), "--snap", "0", "--pinches", "open", "--max-vertices",
                  "6000", "--size-shore", "2261.2280973999214", "--shore-rate", "0.2", "--smooth", "--target",
                  "dflowfm", "--report", file("report.json"), "-o", file("m.nc")});
  EXPECT_EQ(run.code, 1) << run.errors;  // some defects remain
  const Json report = Json::parse(readText(file("report.json")));
  EXPECT_GT(report.at("repairs").at("done").size(), 20u);
  EXPECT_EQ(report.at("mesh").at("turned").at("count"), 0) << run.errors;
}

TEST_F(Target, ADoubledNodeHasTheSizeOfTheNodeThatItWas) {
  const std::string input = inputFile("target/islands_that_touch.geojson");
  ASSERT_EQ(runProgram({"mesh", input, "--size", "20000", "-o", file("plain.geojson")}).code, 0);
  const auto plain = sizesIn(file("plain_nodes.geojson"));
  ASSERT_TRUE(plain.contains({0.5, 0.5}));
  const ProgramRun run = runProgram({"mesh", input, "--size", "20000", "--target", "adcirc", "--report",
                                     file("report.json"), "-o", file("mended.geojson")});
  ASSERT_EQ(run.code, 0) << run.errors;
  const Json repairs = Json::parse(readText(file("report.json"))).at("repairs").at("done");
  ASSERT_EQ(repairs.size(), 1u);
  EXPECT_THAT(repairs[0].at("repair").get<std::string>(), testing::StartsWith("node duplicated"));
  const auto mended = sizesIn(file("mended_nodes.geojson"));
  ASSERT_EQ(mended.size(), plain.size() + 1);
  for (const auto& [place, size] : mended) {
    const auto was = plain.contains(place) ? plain.at(place) : plain.at({0.5, 0.5});
    EXPECT_EQ(size, was) << place.first << ", " << place.second;
  }
}

}  // namespace
}  // namespace coastmesh::test
