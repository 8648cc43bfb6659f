// Outputs for models of the whole Earth, checked against the rules of these models without code of the library.
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

using ::testing::HasSubstr;
using GlobalModels = ProgramTest;

struct FesomMesh {
  std::vector<std::array<double, 2>> nodes;  // degrees
  std::vector<int> tags;
  std::vector<std::array<std::size_t, 3>> triangles;
};

FesomMesh readFesom(const std::string& folder) {
  FesomMesh mesh;
  std::size_t count = 0, number = 0;
  std::istringstream nodes(readText(folder + "nod2d.out")), elements(readText(folder + "elem2d.out"));
  nodes >> count;
  for (std::size_t i = 0; i < count; ++i) {
    auto& [lon, lat] = mesh.nodes.emplace_back();
    nodes >> number >> lon >> lat >> mesh.tags.emplace_back();
    EXPECT_EQ(number, i + 1);
  }
  elements >> count;
  for (std::size_t t = 0; t < count; ++t) {
    auto& [a, b, c] = mesh.triangles.emplace_back();
    elements >> a >> b >> c;
    --a, --b, --c;
  }
  EXPECT_TRUE(nodes.good() && elements.good());
  return mesh;
}

using Vector = std::array<double, 3>;

Vector vectorOf(const std::array<double, 2>& lonlat) {
  const double lon = lonlat[0] * M_PI / 180.0, lat = lonlat[1] * M_PI / 180.0;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

// The largest angle, and the number of triangles with an angle above 90 degrees: flat ones with corners on a sphere.
std::pair<double, std::size_t> obtuseIn(const FesomMesh& mesh) {
  double largest = 0.0;
  std::size_t obtuse = 0;
  for (const auto& v : mesh.triangles) {
    std::array<double, 3> squares;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector p = vectorOf(mesh.nodes[v[(i + 1) % 3]]), q = vectorOf(mesh.nodes[v[(i + 2) % 3]]);
      squares[i] = 0.0;
      for (std::size_t k = 0; k < 3; ++k) squares[i] += (p[k] - q[k]) * (p[k] - q[k]);
    }
    std::ranges::sort(squares);
    const auto [a, b, c] = squares;
    largest = std::max(largest, std::acos((a + b - c) / (2.0 * std::sqrt(a * b))) * 180.0 / M_PI);
    obtuse += c > a + b;
  }
  return {largest, obtuse};
}

// The number of triangles with fewer than two neighbours. Expects at most two triangles per edge, and tag 1 on the
// coast only.
std::size_t lonelyIn(const FesomMesh& mesh) {
  std::map<std::pair<std::size_t, std::size_t>, int> uses;
  for (const auto& v : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[std::minmax(v[i], v[(i + 1) % 3])];
  std::size_t lonely = 0;
  std::vector<bool> coast(mesh.nodes.size(), false);
  for (const auto& [edge, count] : uses) {
    EXPECT_LE(count, 2);
    if (count == 1) coast[edge.first] = coast[edge.second] = true;
  }
  for (const auto& v : mesh.triangles) {
    int neighbours = 0;
    for (std::size_t i = 0; i < 3; ++i) neighbours += uses[std::minmax(v[i], v[(i + 1) % 3])] == 2;
    lonely += neighbours < 2;
  }
  for (std::size_t i = 0; i < coast.size(); ++i) EXPECT_EQ(mesh.tags[i], coast[i] ? 1 : 0) << i;
  return lonely;
}

// A sea across the antimeridian whose shore has spikes.
std::string starOverTheAntimeridian(double reach) {
  LonLatRing ring;
  for (int k = 0; k < 40; ++k) {
    const double turn = 2.0 * M_PI * k / 40, far = reach * (k % 2 == 0 ? 1.0 : 0.8);
    ring.emplace_back(180.0 + 2.0 * far * std::cos(turn), 60.0 + far * std::sin(turn));
  }
  ring.push_back(ring.front());
  return geoJsonPolygons({{ring}});
}

TEST_F(GlobalModels, FesomsPartitionerStopsAtNothing) {
  const std::string input = write("sea.geojson", starOverTheAntimeridian(5.0));
  const std::vector<std::string> plain{"mesh", input, "--size", "40000", "-o", file("nod2d.out")};
  ASSERT_EQ(runProgram(plain).code, 0);
  EXPECT_GT(lonelyIn(readFesom(file(""))), 0u);
  EXPECT_EQ(runProgram({"check", file("nod2d.out"), "--target", "fesom"}).code, 1);
  std::vector<std::string> mended = plain;
  mended.insert(mended.end(), {"--target", "fesom", "--min-angle", "20", "--overwrite"});
  const ProgramRun run = runProgram(mended);
  EXPECT_EQ(run.code, 0) << run.errors;
  const FesomMesh mesh = readFesom(file(""));
  EXPECT_GT(mesh.triangles.size(), 300u);
  EXPECT_EQ(lonelyIn(mesh), 0u);
  EXPECT_EQ(runProgram({"check", file("nod2d.out"), "--target", "fesom"}).code, 0);
}

TEST_F(GlobalModels, MpasGetsNoObtuseTriangle) {
  const std::string input = write("sea.geojson", starOverTheAntimeridian(5.0));
  const std::vector<std::string> plain{
      "mesh", input, "--size-max", "60000", "-o", file("nod2d.out"), "-o", file("sea_mpas.nc")};
  ASSERT_EQ(runProgram(plain).code, 0);
  const std::size_t obtuse = obtuseIn(readFesom(file(""))).second;
  EXPECT_GT(obtuse, 10u);
  const ProgramRun found = runProgram({"check", file("sea_mpas.nc"), "--target", "mpas"});
  EXPECT_EQ(found.code, 1);
  EXPECT_THAT(found.output, HasSubstr("mpas: large angle: " + std::to_string(obtuse) + "\n"));
  std::vector<std::string> mended = plain;
  mended.insert(mended.end(), {"--target", "mpas", "--max-angle", "89", "--overwrite"});
  const ProgramRun run = runProgram(mended);
  EXPECT_EQ(run.code, 0) << run.errors;
  const FesomMesh mesh = readFesom(file(""));
  EXPECT_GT(mesh.triangles.size(), 300u);
  EXPECT_LE(obtuseIn(mesh).first, 90.0);
  EXPECT_EQ(runProgram({"check", file("sea_mpas.nc"), "--target", "mpas"}).code, 0);
}

// Edges around the pole are 192 and 112 km long; the longest edge is at the equator.
TEST_F(GlobalModels, InfoMeasuresEdgesAtThePole) {
  write("nod2d.out", "7\n1 0 89 1\n2 120 89 1\n3 240 89 1\n4 77 90 0\n5 10 0 1\n6 11.85 0 1\n7 11 1.2 1\n");
  write("elem2d.out", "4\n1 2 4\n2 3 4\n3 1 4\n5 6 7\n");
  const ProgramRun run = runProgram({"info", "--json", file("nod2d.out")});
  ASSERT_EQ(run.code, 0) << run.errors;
  const auto info = nlohmann::json::parse(run.output);
  EXPECT_NEAR(info.at("longest_edge_m").get<double>(), 6378137.0 * 1.85 * M_PI / 180.0, 1.0);
  EXPECT_NEAR(info.at("shortest_edge_m").get<double>(), 111694.0, 100.0);
}

}  // namespace
}  // namespace coastmesh::test
