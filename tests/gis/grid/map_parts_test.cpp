// Triangles of the globe on a map: together they cover it once, even across its ends and around poles.
#include "gis/grid/map_parts.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/gis/globe_samples.hpp"

namespace coastmesh {
namespace {

using testing::octahedralGlobe;
using testing::SpaceVector;
using testing::vectorOf;

using Rotation = std::array<SpaceVector, 3>;

// A rotation about an axis.
Rotation turnAbout(const SpaceVector& axis, double degrees) {
  const double c = std::cos(degrees * M_PI / 180.0), s = std::sin(degrees * M_PI / 180.0);
  const auto& [x, y, z] = axis;
  return {{{c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s},
           {y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s},
           {z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)}}};
}

// Rotates a grid; longitudes are from `west` on.
Grid turned(Grid grid, const Rotation& rotation, double west) {
  for (Point& node : grid.nodes) {
    const SpaceVector v = vectorOf(node);
    SpaceVector w{};
    for (std::size_t k = 0; k < 3; ++k) w[k] = rotation[k][0] * v[0] + rotation[k][1] * v[1] + rotation[k][2] * v[2];
    double lon = std::atan2(w[1], w[0]) * 180.0 / M_PI;
    if (lon < west) lon += 360.0;
    node = {lon, std::atan2(w[2], std::hypot(w[0], w[1])) * 180.0 / M_PI};
  }
  return grid;
}

double areaOf(const MapCutter::Ring& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &p = ring[i], &q = ring[(i + 1) % ring.size()];
    twice += p.x * q.y - q.x * p.y;
  }
  return twice / 2.0;
}

// Each part is counter-clockwise and on the map, no edge spans half of it except along a pole, and the areas add up to
// the map's. As neighbours share straight edges, they cannot overlap then. Returns the number of triangles cut in two.
int expectCovered(const Grid& grid, double west) {
  const MapCutter cutter(grid);
  double area = 0.0;
  int in_two = 0;
  for (const auto& triangle : grid.triangles) {
    const auto parts = cutter.partsOf(triangle);
    in_two += parts.size() == 2;
    EXPECT_LE(parts.size(), 2u);
    for (const auto& ring : parts) {
      EXPECT_GE(ring.size(), 3u);
      const double part = areaOf(ring);
      EXPECT_GT(part, 0.0);
      area += part;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point &p = ring[i], &q = ring[(i + 1) % ring.size()];
        EXPECT_GE(p.x, west);
        EXPECT_LE(p.x, west + 360.0);
        if (std::abs(p.y) != 90.0 || p.y != q.y) {
          EXPECT_LT(std::abs(p.x - q.x), 180.0);
        }
      }
    }
  }
  EXPECT_NEAR(area, 360.0 * 180.0, 1e-6);
  return in_two;
}

TEST(MapCutter, ClosedGlobesCoverTheMapOnce) {
  const auto all = [](const SpaceVector&) { return true; };
  const double half = std::sqrt(0.5);
  std::mt19937_64 random(20261123);
  std::normal_distribution<double> normal;
  for (const double west : {-180.0, 0.0}) {
    // Poles at nodes, on edges, and inside triangles.
    expectCovered(turned(octahedralGlobe(3, all), turnAbout({0, 0, 1}, 0.0), west), west);
    expectCovered(turned(octahedralGlobe(3, all), turnAbout({0, 0, 1}, 10.0), west), west);
    expectCovered(turned(octahedralGlobe(2, all), turnAbout({0, 1, 0}, 0.1), west), west);
    EXPECT_GT(expectCovered(turned(octahedralGlobe(3, all), turnAbout({half, half, 0}, 77.0), west), west), 0);
    for (int round = 0; round < 30; ++round) {
      SpaceVector axis{normal(random), normal(random), normal(random)};
      const double length = std::hypot(axis[0], axis[1], axis[2]);
      for (double& x : axis) x /= length;
      const Grid grid = turned(octahedralGlobe(1 + round % 3, all), turnAbout(axis, 360.0 * normal(random)), west);
      EXPECT_GT(expectCovered(grid, west), 0) << round;
    }
  }
}

// An edge across the pole belongs to two triangles; its ends are half a turn apart.
TEST(MapCutter, EdgesOverThePole) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{0, 80}, {180, 80}, {90, 70}, {-90, 70}};
  grid.triangles = {{0, 2, 1}, {0, 1, 3}};
  const MapCutter cutter(grid);
  // Between 0 and 180 degrees east, and between 180 and 0 degrees west.
  for (std::size_t t = 0; t < 2; ++t) {
    const auto parts = cutter.partsOf(grid.triangles[t]);
    ASSERT_EQ(parts.size(), 1u);
    double low = 360.0, high = -360.0;
    for (const Point& p : parts[0]) {
      low = std::min(low, p.x);
      high = std::max(high, p.x);
    }
    EXPECT_EQ(low, t == 0 ? 0.0 : -180.0);
    EXPECT_EQ(high, t == 0 ? 180.0 : 0.0);
    EXPECT_NEAR(areaOf(parts[0]), 180.0 * 10.0 + 90.0 * 10.0, 1e-9);
  }
}

TEST(MapCutter, LeavesAloneWhatLiesOnTheMap) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{170, 0}, {190, 0}, {180, 10}};  // past 180, in one piece
  grid.triangles = {{0, 1, 2}};
  EXPECT_FALSE(MapCutter(grid).cutsAny());
  grid.nodes[1].x = -170;
  const MapCutter cutter(grid);
  EXPECT_TRUE(cutter.cutsAny());
  const auto parts = cutter.partsOf(grid.triangles[0]);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(areaOf(parts[0]), 50.0, 1e-9);
  EXPECT_NEAR(areaOf(parts[1]), 50.0, 1e-9);
  grid.crs = {};
  EXPECT_FALSE(MapCutter(grid).cutsAny());
}

// No part of a line runs across the map, and together the parts are the whole line.
TEST(MapCutter, LinesEndWhereTheMapEnds) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{170, 0}, {-170, 10}, {180, 20}, {180, 30}, {-170, 40}, {170, 40}, {160, 40}};
  const std::vector<std::uint32_t> nodes{0, 1, 2, 3, 4, 5, 6, 0};
  const MapCutter cutter(grid);
  ASSERT_TRUE(cutter.cutsLine(nodes));
  const auto parts = cutter.partsOfLine(nodes);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].size(), 2u);
  EXPECT_EQ(parts[0][1].x, 180.0);
  EXPECT_NEAR(parts[0][1].y, 5.0, 0.2);  // on the great circle
  // Along the map's end it stays on the side that it came from.
  ASSERT_EQ(parts[1].size(), 6u);
  EXPECT_EQ(parts[1][0], (Point{-180.0, parts[0][1].y}));
  EXPECT_EQ(parts[1][2], (Point{-180.0, 20.0}));
  EXPECT_EQ(parts[1][3], (Point{-180.0, 30.0}));
  EXPECT_EQ(parts[1][5].x, -180.0);
  EXPECT_EQ(parts[2], (std::vector<Point>{{180.0, parts[1][5].y}, {170, 40}, {160, 40}, {170, 0}}));
  EXPECT_FALSE(cutter.cutsLine(std::vector<std::uint32_t>{5, 6, 0}));
}

// A line to a pole ends there and continues from the pole at another longitude, whether the pole is a node or on an
// edge.
TEST(MapCutter, LinesEndAtPoles) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{0, 80}, {77, 90}, {120, 80}, {-60, 80}, {-90, 80}};
  const MapCutter cutter(grid);
  const auto parts = cutter.partsOfLine(std::vector<std::uint32_t>{0, 1, 2, 3, 4});
  EXPECT_EQ(parts, (std::vector<std::vector<Point>>{
                       {{0, 80}, {0, 90}}, {{120, 90}, {120, 80}, {120, 90}}, {{-60, 90}, {-60, 80}, {-90, 80}}}));
}

}  // namespace
}  // namespace coastmesh
