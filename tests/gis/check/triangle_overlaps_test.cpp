// Overlapping sheets, planted in meshes without overlaps.
#include "gis/check/triangle_overlaps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gis/check/node_meets.hpp"
#include "gis/grid/grid_edit.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::lattice;
using ::testing::SizeIs;

Grid gridOf(const TriMesh& mesh, const Crs& crs = {}) {
  Grid grid;
  grid.crs = crs;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  return grid;
}

// Squares from `origin`, in degrees where `crs` has them; longitudes within ±180.
Grid squares(Point origin, double size, const Crs& crs = {}) {
  Grid grid = gridOf(lattice(
                         4, 4, [](int, int) { return true; },
                         [&](int i, int j) {
                           return Point{origin.x + size * i, origin.y + size * j};
                         }),
                     crs);
  if (crs.geographic)
    for (Point& p : grid.nodes) p.x = std::remainder(p.x, 360.0);
  return grid;
}

std::vector<TriangleOverlap> overlapsIn(const Grid& grid) {
  std::vector<EdgeConflict> conflicts;
  return triangleOverlaps(grid, linkTriangles(grid.nodes, grid.triangles, conflicts));
}

std::vector<std::uint32_t> hangingIn(const Grid& grid) {
  std::vector<EdgeConflict> conflicts;
  return hangingNodes(grid, linkTriangles(grid.nodes, grid.triangles, conflicts));
}

TEST(TriangleOverlaps, NoneWhereSheetsAreBesideOneAnother) {
  for (const Crs& crs : {Crs{}, wgs84()}) {
    Grid grid = squares({10.0, 50.0}, 0.25, crs);
    EXPECT_THAT(overlapsIn(grid), IsEmpty());
    appendGrid(grid, squares({11.0, 50.1}, 0.25, crs));  // adjoins a side, with nodes of its own
    EXPECT_THAT(overlapsIn(grid), IsEmpty());
  }
}

TEST(TriangleOverlaps, SheetsOverOneAnother) {
  for (const Crs& crs : {Crs{}, wgs84()}) {
    Grid grid = squares({10.0, 50.0}, 0.25, crs);
    appendGrid(grid, squares({10.6, 50.6}, 0.25, crs));
    // Squares 2 and 3 in both directions of one, 0 and 1 of the other.
    const std::vector<TriangleOverlap> found = overlapsIn(grid);
    EXPECT_THAT(found, ::testing::Not(IsEmpty()));
    for (const auto& [t, other] : found) {
      EXPECT_NE(t < 32, other < 32);
      EXPECT_LT(std::abs(grid.nodes[grid.triangles[t][0]].x - 10.8), 0.5);
    }
  }
}

// The second is entirely inside the first, so no sides cross.
TEST(TriangleOverlaps, ASheetWithinAnother) {
  for (const Crs& crs : {Crs{}, wgs84()}) {
    Grid grid = squares({10.0, 50.0}, 1.0, crs);
    appendGrid(grid, squares({10.6, 51.35}, 0.01, crs));
    EXPECT_THAT(overlapsIn(grid), ::testing::Not(IsEmpty()));
  }
}

TEST(TriangleOverlaps, TheSameSheetTwice) {
  Grid grid = squares({400000.0, 5000000.0}, 1000.0);
  appendGrid(grid, squares({400000.0, 5000000.0}, 1000.0));
  EXPECT_THAT(overlapsIn(grid), ::testing::SizeIs(::testing::Ge(2 * 14u)));
  EXPECT_THAT(repeatedNodes(grid), SizeIs(25));
}

TEST(TriangleOverlaps, ACopyOfATriangle) {
  Grid grid = squares({0.0, 0.0}, 1.0);
  grid.triangles.push_back(grid.triangles[9]);
  const std::vector<TriangleOverlap> found = overlapsIn(grid);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].triangle, 9u);
  EXPECT_EQ(found[0].other, 32u);
  EXPECT_EQ(found[1].triangle, 32u);
}

TEST(TriangleOverlaps, AcrossTheAntimeridian) {
  Grid grid = squares({179.3, -17.0}, 0.25, wgs84());
  EXPECT_THAT(overlapsIn(grid), IsEmpty());
  Grid past180 = squares({10.0, -17.0}, 0.25, wgs84());  // the same place, with longitudes past 180
  for (Point& p : past180.nodes) p.x += 169.4;
  appendGrid(grid, std::move(past180));
  EXPECT_THAT(overlapsIn(grid), ::testing::Not(IsEmpty()));
}

// Sectors around a pole; a second set is rotated by half a sector.
TEST(TriangleOverlaps, RoundAPole) {
  for (const bool corner_at_pole : {true, false}) {
    const auto addCap = [corner_at_pole](Grid& grid, double west) {
      constexpr std::uint32_t kSectors = 6;
      const auto base = static_cast<std::uint32_t>(grid.nodes.size());
      for (std::uint32_t i = 0; i < kSectors; ++i)
        grid.nodes.push_back({std::remainder(west + 60.0 * i, 360.0), corner_at_pole ? 80.0 : 85.0});
      if (corner_at_pole) grid.nodes.push_back({0.0, 90.0});
      for (std::uint32_t i = 0; i < kSectors; ++i) {
        const std::uint32_t next = (i + 1) % kSectors;
        if (corner_at_pole) grid.triangles.push_back({base + i, base + next, base + kSectors});
        if (!corner_at_pole && i > 0 && next > 0) grid.triangles.push_back({base, base + i, base + next});
      }
    };
    Grid grid;
    grid.crs = wgs84();
    addCap(grid, 3.0);
    EXPECT_THAT(overlapsIn(grid), IsEmpty());
    addCap(grid, 33.0);
    EXPECT_THAT(overlapsIn(grid), SizeIs(grid.triangles.size()));
  }
}

// A band that winds around more than once, where each triangle is correctly beside its neighbours.
TEST(TriangleOverlaps, ABandThatWindsOverItself) {
  const auto band = [](double turns) {
    Grid grid;
    constexpr std::uint32_t kSteps = 60;
    for (std::uint32_t i = 0; i <= kSteps; ++i) {
      const double angle = turns * 2.0 * std::numbers::pi * i / kSteps;
      for (const double radius : {100.0, 150.0})
        grid.nodes.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      grid.triangles.push_back({2 * i, 2 * i + 1, 2 * i + 3});
      grid.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 2});
    }
    return grid;
  };
  EXPECT_THAT(overlapsIn(band(0.95)), IsEmpty());
  EXPECT_THAT(overlapsIn(band(1.15)), ::testing::Not(IsEmpty()));
}

// Sheets over one another: each triangle is tested alone against each of those at a side without a neighbour.
TEST(TriangleOverlaps, AreThoseOfPairs) {
  const Grid fine = gridOf(lattice(
      40, 30, [](int, int) { return true; },
      [](int i, int j) {
        return Point{0.5 + 0.1 * i - 0.03 * j, 0.2 + 0.03 * i + 0.1 * j};
      }));
  for (const bool with_fine : {false, true}) {  // beside many triangles at sides, and beside few
    Grid grid = gridOf(lattice(12, 12, [](int i, int j) { return (i + j) % 5 > 0; }));
    if (with_fine) appendGrid(grid, Grid(fine));
    std::vector<EdgeConflict> conflicts;
    const TriMesh mesh = linkTriangles(grid.nodes, grid.triangles, conflicts);
    const auto overlap = [&](std::size_t t, std::size_t other) {
      Grid pair;
      for (const std::size_t of : {t, other}) {
        const auto base = static_cast<std::uint32_t>(pair.nodes.size());
        for (const std::uint32_t node : grid.triangles[of]) pair.nodes.push_back(grid.nodes[node]);
        pair.triangles.push_back({base, base + 1, base + 2});
      }
      return !overlapsIn(pair).empty();
    };
    std::vector<std::uint32_t> expected;
    for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
      bool found = false;
      for (std::uint32_t other = 0; other < grid.triangles.size() && !found; ++other)
        found = other != t && std::ranges::count(mesh.triangles[other].adj, kNone) > 0 && overlap(t, other);
      if (found) expected.push_back(t);
    }
    std::vector<std::uint32_t> found;
    for (const auto& [t, other] : overlapsIn(grid)) {
      found.push_back(t);
      EXPECT_TRUE(overlap(t, other)) << t << " and " << other;
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(found.empty(), !with_fine);
  }
}

TEST(NodeMeets, HangingAndRepeatedNodes) {
  Grid grid = squares({0.0, 0.0}, 1.0);
  EXPECT_THAT(hangingIn(grid), IsEmpty());
  EXPECT_THAT(repeatedNodes(grid), IsEmpty());
  Grid beside = squares({4.0, 0.5}, 1.0);
  appendGrid(grid, std::move(beside));
  // Four nodes on either side, along x = 4, are on edges of the other.
  EXPECT_THAT(hangingIn(grid), ElementsAre(9, 14, 19, 24, 25, 30, 35, 40));
  grid.nodes[49] = grid.nodes[0];
  EXPECT_THAT(repeatedNodes(grid), ElementsAre(49));
}

}  // namespace
}  // namespace coastmesh
