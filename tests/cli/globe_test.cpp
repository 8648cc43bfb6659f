// Meshes of the whole globe, checked from longitudes and latitudes with arithmetic of this file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/cli/program.hpp"

namespace coastmesh::test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;
using Vector = std::array<double, 3>;

constexpr double kEarthArea = 5.10065621724e14;  // square metres on WGS 84

Vector placeOf(double lon_deg, double lat_deg) {
  const double lon = lon_deg * M_PI / 180.0, lat = lat_deg * M_PI / 180.0;
  const double f = 1.0 / 298.257223563, e2 = f * (2.0 - f);
  const double n = 6378137.0 / std::sqrt(1.0 - e2 * std::sin(lat) * std::sin(lat));
  return {n * std::cos(lat) * std::cos(lon), n * std::cos(lat) * std::sin(lon), n * (1.0 - e2) * std::sin(lat)};
}

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct Closed {
  std::size_t nodes = 0, edges = 0, triangles = 0;
  bool each_edge_twice = true, outwards = true;
  double least_angle = 180.0, most_angle = 0.0;
  std::map<int, std::size_t> materials;
};

// Reads a .2dm in longitudes and latitudes.
Closed closedIn(const std::string& text) {
  std::vector<Vector> places;
  std::vector<std::array<std::size_t, 3>> triangles;
  Closed found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string card;
    std::size_t number = 0;
    words >> card >> number;
    if (card == "ND") {
      double lon = 0.0, lat = 0.0;
      words >> lon >> lat;
      places.push_back(placeOf(lon, lat));
    } else if (card == "E3T") {
      auto& [a, b, c] = triangles.emplace_back();
      int material = 0;
      words >> a >> b >> c >> material;
      ++found.materials[material];
    }
  }
  std::set<std::pair<std::size_t, std::size_t>> halves;
  for (const auto& t : triangles) {
    std::array<Vector, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = places.at(t[i] - 1);
    found.outwards = found.outwards && dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), p[0]) > 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      found.each_edge_twice = halves.emplace(t[i], t[(i + 1) % 3]).second && found.each_edge_twice;
      const Vector u = minus(p[(i + 1) % 3], p[i]), v = minus(p[(i + 2) % 3], p[i]), w = cross(u, v);
      const double angle = std::atan2(std::sqrt(dot(w, w)), dot(u, v)) * 180.0 / M_PI;
      found.least_angle = std::min(found.least_angle, angle);
      found.most_angle = std::max(found.most_angle, angle);
    }
  }
  for (const auto& [a, b] : halves) found.each_edge_twice = found.each_edge_twice && halves.contains({b, a});
  found.nodes = places.size();
  found.edges = halves.size() / 2;
  found.triangles = triangles.size();
  return found;
}

void expectClosed(const Closed& mesh) {
  EXPECT_TRUE(mesh.each_edge_twice);
  EXPECT_TRUE(mesh.outwards);
  EXPECT_EQ(mesh.nodes + mesh.triangles, mesh.edges + 2);
}

class Globe : public ProgramTest {
 protected:
  ProgramRun mesh(std::vector<std::string> options, const std::string& name = "globe.2dm") {
    std::vector<std::string> arguments{"mesh"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    for (const char* more : {"--domain", "globe", "--overwrite"}) arguments.emplace_back(more);
    arguments.insert(arguments.end(), {"-o", file(name), "--report", file("report.json")});
    return runProgram(arguments);
  }
  Json report() const { return Json::parse(readText(file("report.json"))); }
  Closed closed() const { return closedIn(readText(file("globe.2dm"))); }
};

TEST_F(Globe, WithoutInputIsClosedAndEven) {
  const ProgramRun run = mesh({"--size", "1000000"});
  ASSERT_EQ(run.code, 0) << run.errors;
  const Closed made = closed();
  expectClosed(made);
  EXPECT_GT(made.least_angle, 49.0);
  EXPECT_LT(made.most_angle, 89.0);
  EXPECT_LT(made.triangles, 1.05 * kEarthArea / (0.4330 * 1e12));
  EXPECT_NEAR(report()["mesh"]["area_m2"].get<double>() / kEarthArea, 1.0, 1e-9);
  EXPECT_EQ(report()["mesh"]["closed"], true);
  EXPECT_EQ(report()["mesh"]["euler"], 2);
  const ProgramRun check = runProgram({"check", file("globe.2dm"), "--assume-crs", "EPSG:4326", "--min-angle", "49"});
  EXPECT_EQ(check.code, 0) << check.output << check.errors;
}

TEST_F(Globe, NeedsASizeWhereNothingLiesOnIt) {
  const ProgramRun run = mesh({});
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(isOneErrorLine(run.errors));
  EXPECT_THAT(run.errors, HasSubstr("--size"));
  EXPECT_EQ(runProgram({"mesh", "-o", file("none.2dm")}).code, 2);
}

TEST_F(Globe, HasNoFrameAndNoPlane) {
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--bbox=-10,-10,10,10"},
                                               {"--crs", "plane"},
                                               {"--surface", "plane"},
                                               {"--coast", "follow"}}) {
    std::vector<std::string> options{"--size", "1000000"};
    options.insert(options.end(), more.begin(), more.end());
    const ProgramRun run = mesh(options);
    EXPECT_EQ(run.code, 2) << more.front();
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
  }
}

TEST_F(Globe, ACleanedFileIsMeshedAsItsInput) {
  const std::string land =
      write("land.geojson",
            geoJsonPolygons({{{{0, 50}, {20, 48}, {25, 60}, {5, 62}}}, {{{70, -10}, {80, -9}, {79, 5}, {72, 6}}}}));
  const std::string cleaned = file("cleaned.gpkg");
  ASSERT_EQ(runProgram({"clean", land, "--domain", "globe", "-o", cleaned}).code, 0);
  std::vector<std::string> made;
  for (const std::string& input : {land, cleaned}) {
    const ProgramRun run = mesh({input, "--size", "700000"});
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.errors, "");
    EXPECT_EQ(report()["clean"]["features_overlap"], 0);
    made.push_back(readText(file("globe.2dm")));
  }
  EXPECT_TRUE(made[0] == made[1]);
  const ProgramRun poly = runProgram({"clean", land, "--domain", "globe", "-o", file("cleaned.poly")});
  EXPECT_EQ(poly.code, 2);
  EXPECT_TRUE(isOneErrorLine(poly.errors)) << poly.errors;
  EXPECT_THAT(poly.errors, HasSubstr("cannot hold the rest of the globe"));
}

TEST_F(Globe, LandAndSeaAreRegionsOfOneMesh) {
  // An island, one across the antimeridian cut in two, and a continent round the south pole, closed along it.
  const std::string land = write("land.geojson", geoJsonPolygons({{{{0, 50}, {20, 48}, {25, 60}, {5, 62}}},
                                                                  {{{170, -10}, {180, -12}, {180, 8}, {172, 6}}},
                                                                  {{{-180, -12}, {-171, -9}, {-172, 5}, {-180, 8}}},
                                                                  {{{-180, -90},
                                                                    {180, -90},
                                                                    {180, -70},
                                                                    {120, -66},
                                                                    {60, -70},
                                                                    {0, -68},
                                                                    {-60, -64},
                                                                    {-120, -72},
                                                                    {-180, -70}}}}));
  const ProgramRun run = mesh({land, "--size", "600000"});
  ASSERT_EQ(run.code, 0) << run.errors;
  const Closed made = closed();
  expectClosed(made);
  EXPECT_EQ(made.materials.size(), 5u);
  EXPECT_GT(made.least_angle, 33.0);
  EXPECT_NEAR(report()["mesh"]["area_m2"].get<double>() / kEarthArea, 1.0, 1e-9);
  // --dissolve joins the two halves, so that no border along the antimeridian remains.
  ASSERT_EQ(mesh({land, "--size", "600000", "--dissolve"}).code, 0);
  EXPECT_EQ(closed().materials.size(), 4u);
  expectClosed(closed());
}

TEST_F(Globe, TwoPointsNearToOneAnotherNeedNoSize) {
  const std::string points =
      write("points.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":)"
                              R"({"type":"MultiPoint","coordinates":[[10,45],[10,45.00001]]}}]})");
  for (const char* angle : {"30", "38", "42"}) {
    const ProgramRun run = mesh({"--constraints", points, "--min-angle", angle});
    ASSERT_EQ(run.code, 0) << run.errors;
    const Closed made = closed();
    expectClosed(made);
    EXPECT_GE(made.least_angle, std::stod(angle));
    if (std::string(angle) == "30") {
      EXPECT_LE(made.nodes, 302u);
    }
  }
}

TEST_F(Globe, SizesGrowFromShores) {
  const std::string land = write("land.geojson", geoJsonPolygons({{{{0, 50}, {20, 48}, {25, 60}, {5, 62}}}}));
  const ProgramRun run = mesh({land, "--size-shore", "100000", "--size-max", "1000000", "--max-angle", "89"});
  ASSERT_EQ(run.code, 0) << run.errors;
  const Closed made = closed();
  expectClosed(made);
  EXPECT_GT(made.least_angle, 33.0);
  EXPECT_LT(made.most_angle, 90.0);
  EXPECT_GT(made.triangles, 2000u);
  EXPECT_LT(made.triangles, 8000u);
}

// With these islands the node opposite to the middle of the plane is at its infinity, and not just far away.
TEST_F(Globe, CanBeCheckedAgainstItsInputOnASphere) {
  std::vector<std::vector<LonLatRing>> islands;
  const LonLatRing middles{{0, 0}, {60, 20}, {130, -25}, {-100, 40}, {-60, -20}, {20, 60}, {100, 50}, {-150, -60}};
  for (const auto& [x, y] : middles) {
    LonLatRing& ring = islands.emplace_back(1).front();
    for (int i = 0; i < 12; ++i)
      ring.push_back({x + 8.0 * std::cos(i * M_PI / 6.0), y + 8.0 * std::sin(i * M_PI / 6.0)});
  }
  const std::string land = write("islands.geojson", geoJsonPolygons(islands));
  ASSERT_EQ(mesh({land, "--size", "400000", "--surface", "sphere"}, "globe.nc").code, 0);
  const ProgramRun check =
      runProgram({"check", file("globe.nc"), "--surface", "sphere", "--input", land, "--domain", "globe"});
  EXPECT_EQ(check.code, 0) << check.errors << check.output;
}

TEST_F(Globe, IsTheSameForAnyNumberOfThreads) {
  const std::string land = write("land.geojson", geoJsonPolygons({{{{0, 50}, {20, 48}, {25, 60}, {5, 62}}}}));
  std::set<std::string> digests;
  for (const char* threads : {"1", "2", "3"}) {
    ASSERT_EQ(mesh({land, "--size", "100000", "--threads", threads}).code, 0);
    digests.insert(report()["mesh"]["digest"].get<std::string>());
  }
  EXPECT_EQ(digests.size(), 1u);
}

TEST_F(Globe, GoesIntoFilesOfAllKinds) {
  for (const char* name : {"globe.nc", "nod2d.out", "globe_mpas.nc", "globe_jigsaw.msh", "globe.vtu", "globe.gpkg"}) {
    const ProgramRun run = mesh({"--size", "2000000"}, name);
    EXPECT_EQ(run.code, 0) << name << run.errors;
    const ProgramRun check = runProgram({"check", file(name)});
    EXPECT_EQ(check.code, 0) << name << check.output << check.errors;
  }
}

}  // namespace
}  // namespace coastmesh::test
