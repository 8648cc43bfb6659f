// Reports of the time step that a grid allows, and of violations of --time-step and --size-min.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class TimeStep : public ProgramTest {
 protected:
  // A bay of 60 by 40 km in metres, with notches of 100 m in its shore.
  std::string bay() const {
    std::string ring;
    const auto add = [&](double x, double y) {
      ring += (ring.empty() ? "[" : ", [") + std::to_string(x) + ", " + std::to_string(y) + "]";
    };
    for (int i = 0; i <= 60; ++i) add(1000.0 * i, i % 3 == 1 ? 100.0 : 0.0);
    add(60000, 40000), add(0, 40000), add(0, 0);
    return write(
        "bay.geojson",
        R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32631"}}, )"
        R"("features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[)" +
            ring + "]]}}]}");
  }
  // 10 m deep in the south, 1000 m in the north.
  std::string depths() const {
    std::string text = "ncols 140\nnrows 100\nxllcorner -5000\nyllcorner -5000\ncellsize 500\n";
    for (int j = 0; j < 100; ++j) {
      const double y = 50000.0 - 500.0 * j - 5250.0;
      for (int i = 0; i < 140; ++i) text += std::to_string(y < 20000.0 ? -10.0 : -1000.0) + " ";
      text += "\n";
    }
    return write("bed.asc", text);
  }
  // From 10 m deep in the south to 500 m in the north, with no data in the middle.
  std::string bedWithGap() const {
    std::string text = "ncols 140\nnrows 100\nxllcorner -5000\nyllcorner -5000\ncellsize 500\nNODATA_value -9999\n";
    for (int j = 0; j < 100; ++j) {
      const double y = 50000.0 - 500.0 * j - 5250.0;
      for (int i = 0; i < 140; ++i) {
        const double x = 500.0 * i - 4750.0;
        const bool unknown = x > 15000.0 && x < 45000.0 && y > 5000.0 && y < 35000.0;
        text += std::to_string(unknown ? -9999.0 : -10.0 - 490.0 * std::clamp(y / 40000.0, 0.0, 1.0)) + " ";
      }
      text += "\n";
    }
    return write("gap.asc", text);
  }
  // A sea of 120 by 60 km with a ragged coast in the south, and a bed that falls from the coast to 305 m.
  std::string raggedSea() const {
    std::string ring;
    for (int i = 0; i <= 600; ++i) {
      const double x = 200.0 * i;
      const double y = 20000.0 + 3000.0 * std::sin(x / 9000.0) + 1500.0 * std::sin(x / 2300.0) +
                       700.0 * std::sin(x / 870.0) + 300.0 * (i % 3);
      ring += "[" + std::to_string(x) + ", " + std::to_string(y) + "], ";
    }
    ring += "[120000, 80000], [0, 80000], [0, 20000]";
    return write(
        "ragged.geojson",
        R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32631"}}, )"
        R"("features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[)" +
            ring + "]]}}]}");
  }
  std::string raggedBed() const {
    std::string text = "ncols 240\nnrows 160\nxllcorner 0\nyllcorner 0\ncellsize 500\n";
    for (int j = 0; j < 160; ++j) {
      const double y = 80000.0 - 500.0 * (j + 0.5);
      for (int i = 0; i < 240; ++i)
        text += std::to_string(-5.0 - 300.0 * std::clamp((y - 14000.0) / 20000.0, 0.0, 1.0)) + " ";
      text += "\n";
    }
    return write("ragged.asc", text);
  }
  ProgramRun mesh(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"mesh", bay(), "-o", file("bay.2dm"), "--report", file("r.json"), "--overwrite"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  }
  Json step() const { return Json::parse(readText(file("r.json"))).at("step"); }

  struct Node {
    double x, y, z;
  };
  // Calls `visit(card, words)` for each line of the .2dm, with the words after the number.
  template <typename Visit>
  void forCards(const Visit& visit) const {
    std::istringstream text(readText(file("bay.2dm")));
    for (std::string line; std::getline(text, line);) {
      std::istringstream words(line);
      std::string card;
      std::size_t number = 0;
      words >> card >> number;
      visit(card, words);
    }
  }
  std::vector<Node> readNodes() const {
    std::vector<Node> nodes;
    forCards([&](const std::string& card, std::istringstream& words) {
      if (card == "ND") words >> nodes.emplace_back().x >> nodes.back().y >> nodes.back().z;
    });
    return nodes;
  }
  // The shortest and the longest time step of triangles in a .2dm, without code of the library; those of dry ones are
  // infinite and do not count as the longest.
  double leastStep() const { return stepRange().first; }
  double mostStep() const { return stepRange().second; }
  std::pair<double, double> stepRange() const {
    const std::vector<Node> nodes = readNodes();
    std::vector<std::array<std::size_t, 3>> triangles;
    forCards([&](const std::string& card, std::istringstream& words) {
      if (card == "E3T") words >> triangles.emplace_back()[0] >> triangles.back()[1] >> triangles.back()[2];
    });
    double least = INFINITY, most = 0.0;
    for (const auto& v : triangles) {
      double edge = INFINITY, depth = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Node &a = nodes.at(v[i] - 1), &b = nodes.at(v[(i + 1) % 3] - 1);
        edge = std::min(edge, std::hypot(a.x - b.x, a.y - b.y));
        depth = std::max(depth, -a.z);
      }
      const double step = edge / std::sqrt(9.81 * depth);
      least = std::min(least, step);
      if (std::isfinite(step)) most = std::max(most, step);
    }
    return {least, most};
  }
};

// Repairs of the time step must not make obtuse triangles; what they cannot repair is reported.
TEST_F(TimeStep, RepairsKeepCircumcentresInside) {
  const std::vector<std::string> options{"mesh",         raggedSea(),  "--bathymetry", raggedBed(),
                                         "--size-shore", "800",        "--size-max",   "4000",
                                         "--time-step",  "24",         "--quality",    "centred",
                                         "-o",           file("a.nc"), "--report",     file("r.json")};
  const ProgramRun run = runProgram(options);
  EXPECT_EQ(run.code, 1);
  const Json report = Json::parse(readText(file("r.json")));
  EXPECT_GT(report.at("repairs").at("done").size(), 10u);
  EXPECT_GT(report.at("step").at("asked").at("missed"), 0);
  EXPECT_EQ(report.at("refine").at("unresolved").at("count"), 0);
  EXPECT_THAT(run.errors, HasSubstr("--quality centred, which may make no angle above 90 degrees"));
}

// Nodes get depths there too, and sizes must be large enough for these.
TEST_F(TimeStep, HoldsWhereNoRasterHasADepth) {
  const std::vector<std::string> options{"--bathymetry", bedWithGap(), "--size", "400", "--time-step", "15"};
  ProgramRun run = mesh(options);
  EXPECT_EQ(run.code, 0) << run.errors;
  const Json report = Json::parse(readText(file("r.json")));
  EXPECT_GT(report.at("depth").at("filled"), 500);
  EXPECT_EQ(report.at("step").at("asked").at("missed"), 0);
  EXPECT_LE(report.at("repairs").at("done").size(), 5u);
  EXPECT_THAT(run.output, HasSubstr("no raster has a depth for about "));
  EXPECT_THAT(run.output, HasSubstr("km² of the water"));
  // The same bytes for any number of threads.
  const std::string one = readText(file("bay.2dm"));
  std::vector<std::string> threads = options;
  threads.insert(threads.end(), {"--threads", "3"});
  EXPECT_EQ(mesh(threads).code, 0);
  EXPECT_TRUE(readText(file("bay.2dm")) == one);
}

TEST_F(TimeStep, IsSaidInSummaryReportAndInfo) {
  const ProgramRun without = mesh({"--size", "2000"});
  EXPECT_THAT(without.output, HasSubstr("without depths there is no time step"));
  EXPECT_TRUE(step().at("time_step_s").is_null());
  const ProgramRun run = mesh({"--size", "2000", "--bathymetry", depths()});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, HasSubstr("time step by CFL "));
  // The file has lengths of UTM's plane, which so near to its meridian differ by at most a few thousandths from those
  // on the ground.
  EXPECT_NEAR(step().at("time_step_s").get<double>() / leastStep(), 1.0, 0.01);
  const Json info = Json::parse(runProgram({"info", "--json", file("bay.2dm")}).output);
  EXPECT_NEAR(info.at("step").at("time_step_s").get<double>(), leastStep(), 0.01 * leastStep());
  EXPECT_THAT(runProgram({"info", file("bay.2dm")}).output, HasSubstr("time step by CFL "));
}

TEST_F(TimeStep, AskedForHoldsOrIsListedWithExitCode1) {
  const ProgramRun follows =
      mesh({"--size", "300", "--time-step", "20", "--bathymetry", depths(), "--coast", "follow", "--size-max", "9000"});
  EXPECT_EQ(follows.code, 0) << follows.errors;
  EXPECT_GE(leastStep(), 20.0 * 0.997);
  EXPECT_EQ(step().at("asked").at("missed"), 0);

  // The notches of a coast that is kept are too short for the time step.
  const ProgramRun keeps = mesh({"--size", "3000", "--time-step", "120", "--bathymetry", depths()});
  EXPECT_EQ(keeps.code, 1);
  EXPECT_THAT(keeps.errors, HasSubstr("--time-step 120 at --courant 1 does not hold in "));
  EXPECT_THAT(keeps.errors, HasSubstr("--coast follow"));
  const Json asked = step().at("asked");
  EXPECT_GT(asked.at("missed").get<int>(), 0);
  EXPECT_NEAR(asked.at("places").at(0).at("time_step_s").get<double>() / leastStep(), 1.0, 0.01);
}

// As models want whose schemes damp waves at small Courant numbers.
TEST_F(TimeStep, CourantNumbersReachTheLeast) {
  const std::vector<std::string> options{"--size-shore", "2000",        "--size-max",   "20000",     "--grade",
                                         "0.5",          "--time-step", "30",           "--courant", "20",
                                         "--coast",      "follow",      "--bathymetry", depths()};
  ASSERT_EQ(mesh(options).code, 0);
  EXPECT_GT(mostStep(), 2.0 * 30.0 / 0.6);
  std::vector<std::string> with = options;
  with.insert(with.end(), {"--courant-min", "0.6"});
  const ProgramRun run = mesh(with);
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_LE(mostStep(), 1.003 * 30.0 / 0.6);
  EXPECT_EQ(step().at("asked").at("courant_min"), 0.6);
  EXPECT_EQ(step().at("asked").at("missed_min"), 0);
  // The other bounds of sizes go before, and what then misses the number is reported.
  with.insert(with.end(), {"--size-min", "3000"});
  const ProgramRun bounded = mesh(with);
  EXPECT_EQ(bounded.code, 1);
  EXPECT_THAT(bounded.errors, HasSubstr("--courant-min 0.6 with --time-step 30 is not reached in "));
  EXPECT_THAT(bounded.errors, HasSubstr("or a smaller --size-min helps"));
  EXPECT_GT(step().at("asked").at("missed_min").get<int>(), 0);
}

TEST_F(TimeStep, TheLeastCourantNumberIsFarBelowTheMost) {
  const ProgramRun run =
      mesh({"--size", "2000", "--time-step", "30", "--bathymetry", depths(), "--courant-min", "0.4"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.errors, HasSubstr("--courant-min 0.4 needs a --courant of at least 1.2"));
}

// Some edges of a coast that follows sizes are too short for the step; they are repaired in the mesh.
TEST_F(TimeStep, AskedForHoldsAlongARaggedCoast) {
  const ProgramRun run =
      runProgram({"mesh", raggedSea(), "-o", file("bay.2dm"), "--report", file("r.json"), "--size", "600", "--size-max",
                  "9000", "--time-step", "30", "--bathymetry", raggedBed(), "--coast", "follow"});
  EXPECT_EQ(run.code, 0) << run.errors;
  EXPECT_GE(leastStep(), 30.0 * 0.997);
  const Json report = Json::parse(readText(file("r.json")));
  EXPECT_EQ(report.at("step").at("asked").at("missed"), 0);
  const Json done = report.at("repairs").at("done");
  ASSERT_FALSE(done.empty());
  for (const Json& repair : done) EXPECT_EQ(repair.at("defect"), "courant");
  // The mesh is no worse and the sea is the same.
  EXPECT_EQ(report.at("mesh").at("below_bound"), 0);
  const double meshed = report.at("mesh").at("area_m2"), given = report.at("input").at("area_m2");
  EXPECT_NEAR(meshed / given, 1.0, 0.005);
  EXPECT_EQ(runProgram({"check", file("bay.2dm"), "--target", "adcirc", "--min-angle", "33"}).code, 0);
}

TEST_F(TimeStep, SizeMinThatTheCoastUndercutsIsSaid) {
  const ProgramRun keeps = mesh({"--size", "3000", "--size-min", "2000"});
  EXPECT_EQ(keeps.code, 0);
  EXPECT_THAT(keeps.errors, HasSubstr("edges shorter than 0.7 times --size-min 2000: "));
  EXPECT_FALSE(step().at("size_min").at("missed").get<bool>());
  const ProgramRun follows = mesh({"--size", "3000", "--size-min", "2000", "--coast", "follow"});
  EXPECT_EQ(follows.code, 0) << follows.errors;
  const Json undercut = step().at("size_min");
  for (const Json& place : undercut.at("places")) {
    EXPECT_GE(place.at("length_m").get<double>(), 1000.0);
    EXPECT_LT(place.at("length_m").get<double>(), 1400.0);
  }
}

// Its shore stays as it is, so that the advice to request larger sizes would be of no use.
TEST_F(TimeStep, ALakeWithoutRoomForAnElementNeedsASmallerSizeMin) {
  const std::string pond =
      write("pond.geojson", geoJsonPolygons({{{{10.0, 60.0}, {10.01, 60.0}, {10.01, 60.005}, {10.0, 60.005}}}}));
  const ProgramRun run = runProgram(
      {"mesh", pond, "--size", "3000", "--size-min", "2000", "--coast", "follow", "-o", file("pond.nc"), "--quiet"});
  EXPECT_EQ(run.code, 1) << run.errors;
  EXPECT_THAT(run.errors, HasSubstr("in the 1 part narrower than an element, which stays as in the input, larger "
                                    "sizes do not help: a smaller --size-min does"));
}

// Two requested points are too near to one another.
TEST_F(TimeStep, AQuietRunSaysThatSizeMinIsMissed) {
  const std::string points =
      write("gauges.geojson",
            R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32631"}}, )"
            R"("features": [{"type": "Feature", "properties": {}, "geometry": )"
            R"({"type": "MultiPoint", "coordinates": [[30000, 20000], [30050, 20000]]}}]})");
  const ProgramRun run =
      mesh({"--size", "3000", "--size-min", "2000", "--coast", "follow", "--constraints", points, "--quiet"});
  EXPECT_EQ(run.code, 1);
  EXPECT_TRUE(step().at("size_min").at("missed").get<bool>());
  EXPECT_THAT(run.errors, HasSubstr("edges are far shorter than --size-min"));
  EXPECT_THAT(run.errors, Not(HasSubstr("the time step is not held")));
}

// At the equator angles on a sphere with unchanged latitudes differ most from those on the ellipsoid, which count.
TEST_F(TimeStep, RepairsKeepTheMinimumAngleAtTheEquator) {
  std::string ring;
  for (int i = 0; i <= 600; ++i) {
    const double x = 200.0 * i;
    const double y = -20000.0 + 3000.0 * std::sin(x / 9000.0) + 1500.0 * std::sin(x / 2300.0) +
                     700.0 * std::sin(x / 870.0) + 300.0 * (i % 3);
    ring += "[" + std::to_string(x / 1e5) + ", " + std::to_string(y / 1e5) + "], ";
  }
  const std::string sea =
      write("equator.geojson", R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, )"
                               R"("geometry": {"type": "Polygon", "coordinates": [[)" +
                                   ring + "[1.2, 0.4], [0, 0.4], [0, -0.2]]]}}]}");
  std::string bed = "ncols 240\nnrows 160\nxllcorner 0\nyllcorner -0.4\ncellsize 0.005\n";
  for (int j = 0; j < 160; ++j) {
    const double z = -5.0 - 300.0 * std::clamp((66000.0 - 500.0 * (j + 0.5)) / 20000.0, 0.0, 1.0);
    for (int i = 0; i < 240; ++i) bed += std::to_string(z) + " ";
    bed += "\n";
  }
  const std::string depths = write("equator.asc", bed);
  runProgram({"mesh", sea, "--bathymetry", depths, "--size-shore", "800", "--size-max", "4000", "--time-step", "30",
              "-o", file("e.2dm"), "--report", file("r.json")});
  const Json report = Json::parse(readText(file("r.json")));
  EXPECT_GT(report.at("repairs").at("done").size(), 20u);
  EXPECT_EQ(report.at("refine").at("unresolved").at("count"), 0);
}

// Repairs would move or remove many of them, since each has another 120 m away.
TEST_F(TimeStep, RequestedPointsStayWhereTheyAre) {
  std::string places, separator;
  std::vector<std::pair<double, double>> given;
  for (int i = 0; i < 40; ++i) {
    const double x = 3000.0 + 2800.0 * (i % 20), y = 32000.0 + 20000.0 * (i / 20) + 700.0 * (i % 7);
    for (const double apart : {0.0, 120.0}) {
      given.emplace_back(x + apart, y);
      places += separator + "[" + std::to_string(x + apart) + ", " + std::to_string(y) + "]";
      separator = ", ";
    }
  }
  const std::string points = write(
      "gauges.geojson",
      R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32631"}}, )"
      R"("features": [{"type": "Feature", "properties": {}, "geometry": {"type": "MultiPoint", "coordinates": [)" +
          places + "]}}]}");
  const ProgramRun run = runProgram({"mesh", raggedSea(), "--bathymetry", raggedBed(), "--size-shore", "800",
                                     "--size-max", "4000", "--coast", "follow", "--time-step", "20", "--constraints",
                                     points, "-o", file("bay.2dm"), "--report", file("r.json")});
  EXPECT_GT(Json::parse(readText(file("r.json"))).at("repairs").at("done").size(), 20u) << run.errors;
  const std::vector<Node> nodes = readNodes();
  for (const auto& [x, y] : given)
    EXPECT_EQ(std::ranges::count_if(nodes, [&](const Node& node) { return node.x == x && node.y == y; }), 1)
        << x << ", " << y;
}

TEST_F(TimeStep, SizeMinHoldsForEdgesWhereTheCoastFollows) {
  for (const std::string quality : {"shape", "centred"}) {
    SCOPED_TRACE(quality);
    const ProgramRun run = runProgram({"mesh", raggedSea(), "-o", file("bay.2dm"), "--report", file("r.json"),
                                       "--overwrite", "--size-shore", "1000", "--size-min", "1000", "--size-max",
                                       "9000", "--coast", "follow", "--quality", quality});
    EXPECT_EQ(run.code, 0) << run.errors;
    const Json report = Json::parse(readText(file("r.json")));
    const Json undercut = report.at("step").at("size_min");
    EXPECT_FALSE(undercut.at("missed").get<bool>());
    EXPECT_LT(undercut.at("shorter").get<double>(), 0.01 * report.at("mesh").at("vertices").get<double>());
    EXPECT_EQ(report.at("mesh").at("below_bound"), 0);
    EXPECT_LE(report.at("mesh").at("max_angle_deg").get<double>(), quality == "centred" ? 90.0 : 120.0);
    const double meshed = report.at("mesh").at("area_m2"), given = report.at("input").at("area_m2");
    EXPECT_NEAR(meshed / given, 1.0, 0.005);
  }
}

// Edge lengths scatter around the size: if that is --size-min everywhere, slightly shorter edges give no warning.
TEST_F(TimeStep, SizeMinIsNotUndercutByTheUsualSpreadOfEdges) {
  const std::string square = write("square.geojson", geoJsonPolygons({{{{0, 0}, {0.2, 0}, {0.2, 0.2}, {0, 0.2}}}}));
  const ProgramRun run = runProgram(
      {"mesh", square, "-o", file("s.2dm"), "--report", file("r.json"), "--size", "1000", "--size-min", "2000"});
  EXPECT_EQ(run.code, 0) << run.errors;
  const Json step = Json::parse(readText(file("r.json"))).at("step");
  EXPECT_LT(step.at("shortest_edge_m").get<double>(), 2000.0);
  EXPECT_EQ(step.at("size_min").at("shorter"), 0);
  EXPECT_EQ(run.errors, "");
}

TEST_F(TimeStep, CheckListsTheWorstFirstAndKeepsAdviceApart) {
  ASSERT_EQ(mesh({"--size", "2000", "--bathymetry", depths()}).code, 0);
  const ProgramRun any = runProgram({"check", file("bay.2dm"), "--time-step", "60"});
  EXPECT_EQ(any.code, 1);
  const std::size_t at = any.output.find("courant: ");
  ASSERT_NE(at, std::string::npos) << any.output;
  const std::string first = any.output.substr(any.output.find(", triangle", at));
  double worst = 0.0;
  ASSERT_EQ(std::sscanf(first.c_str(), ", triangle %*d, %lf", &worst), 1);
  EXPECT_NEAR(worst, 60.0 / leastStep(), 0.01 * worst);

  const ProgramRun schism = runProgram({"check", file("bay.2dm"), "--target", "schism", "--time-step", "10"});
  EXPECT_THAT(schism.output, HasSubstr("schism: advice, courant: "));
  EXPECT_THAT(schism.output, Not(HasSubstr("schism: courant")));

  // Models without a limit.
  for (const char* model : {"fesom", "mpas", "swan"}) {
    const ProgramRun run = runProgram({"check", file("bay.2dm"), "--target", model, "--time-step", "60"});
    EXPECT_THAT(run.output, Not(HasSubstr("courant"))) << model;
    EXPECT_THAT(run.errors, HasSubstr("--time-step has no effect if --target is fesom, mpas or swan alone")) << model;
  }
  const ProgramRun both = runProgram({"check", file("bay.2dm"), "--target=swan", "--target=adcirc", "--time-step=60"});
  EXPECT_THAT(both.output, HasSubstr("adcirc: courant: "));
  EXPECT_THAT(both.errors, Not(HasSubstr("no effect")));
}

// Land with a ragged coast in the south of a box; the sea is 3 m deep at the coast and 4000 m far from it.
TEST_F(TimeStep, ASeaForAModelHasSizesThatSuitIt) {
  LonLatRing land{{-1.0, 39.0}};
  for (int i = 0; i <= 400; ++i) {
    const double x = -1.0 + 0.015 * i;
    land.emplace_back(x, 41.0 + 0.3 * std::sin(3.0 * x) + 0.04 * std::sin(41.0 * x) + 0.01 * (i % 3));
  }
  land.emplace_back(5.0, 39.0);
  land.push_back(land.front());
  const std::string coast = write("land.geojson", geoJsonPolygons({{land}}));
  std::string text = "ncols 120\nnrows 100\nxllcorner -1\nyllcorner 40\ncellsize 0.05\n";
  for (int j = 0; j < 100; ++j) {
    for (int i = 0; i < 120; ++i) {
      const double x = -1.0 + 0.05 * (i + 0.5), y = 45.0 - 0.05 * (j + 0.5);
      const double from_shore = std::max(0.0, y - 41.0 - 0.3 * std::sin(3.0 * x));
      text +=
          std::to_string(-3.0 - std::min(4000.0, 100.0 * from_shore + 2000.0 * std::max(0.0, from_shore - 1.0))) + " ";
    }
    text += "\n";
  }
  const std::vector<std::string> command{
      "mesh",     coast,    "--domain", "outside",      "--bbox=0,40.2,4,44", "--bathymetry", write("sea.asc", text),
      "--target", "adcirc", "--report", file("r.json"), "--overwrite"};
  const auto runWith = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram(arguments);
  };
  const ProgramRun run = runWith({"-o", file("chosen.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  const Json report = Json::parse(readText(file("r.json")));
  EXPECT_GE(report.at("mesh").at("vertices").get<int>(), 10'000);
  EXPECT_LE(report.at("mesh").at("vertices").get<int>(), 100'000);
  EXPECT_GE(report.at("step").at("time_step_s").get<double>(), 5.0);

  // The options that the summary names make the same mesh.
  const std::string lead = "as with ";
  const std::size_t at = run.output.find(lead);
  ASSERT_NE(at, std::string::npos) << run.output;
  std::istringstream said(run.output.substr(at + lead.size(), run.output.find(',', at) - at - lead.size()));
  std::vector<std::string> options{"-o", file("said.14")};
  for (std::string word; said >> word;) options.push_back(word);
  EXPECT_GE(options.size(), 14u);
  ASSERT_EQ(runWith(options).code, 0);
  EXPECT_TRUE(readText(file("chosen.14")) == readText(file("said.14")));
}

TEST_F(TimeStep, IsDrawn) {
  ASSERT_EQ(mesh({"--size", "2000", "--bathymetry", depths()}).code, 0);
  const ProgramRun run = runProgram({"plot", file("bay.2dm"), "-o", file("step.svg"), "--color", "timestep"});
  EXPECT_EQ(run.code, 0) << run.errors;
  ASSERT_EQ(runProgram({"plot", file("bay.2dm"), "-o", file("size.svg"), "--color", "size"}).code, 0);
  EXPECT_TRUE(readText(file("step.svg")) != readText(file("size.svg")));
  ASSERT_EQ(mesh({"--size", "2000"}).code, 0);
  EXPECT_EQ(runProgram({"plot", file("bay.2dm"), "-o", file("none.svg"), "--color", "timestep"}).code, 3);
}

}  // namespace
}  // namespace coastmesh::test
