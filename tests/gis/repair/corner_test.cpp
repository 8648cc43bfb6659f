// Corners of the boundary where a triangle has two open edges, or an open one and a solid one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/quality.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/local_plane.hpp"
#include "tests/gis/check/target_samples.hpp"
#include "tests/gis/repair/slanting_sea.hpp"

namespace coastmesh {
namespace {

using testing::inDegrees;
using testing::kindsIn;

constexpr std::uint32_t kRow = 7;  // nodes
constexpr double kBoundDeg = 33.0;
constexpr std::array kFvcom{Target::Fvcom};

BoundaryKind openInTheSouth(std::uint32_t from, std::uint32_t to) {
  return {from < kRow && to < kRow ? BoundaryRole::Open : BoundaryRole::Land};
}

Grid slantingSea(double corner_deg, const BoundaryKindOf& kind_of = openInTheSouth) {
  return testing::slantingSea(kRow - 1, corner_deg, kind_of);
}

double leastAngleOf(const Grid& grid) {
  double least = 180.0;
  for (const GridCorners& corners : grid.triangles) {
    const auto p = localPlane(grid, corners);
    least = std::min(least, leastAngleDeg(p[0], p[1], p[2]));
  }
  return least;
}

auto cutsIn(const RepairReport& report) { return std::ranges::count(report.repairs, "corner cut off", &Repair::what); }

TEST(Corner, TooSharpForTwoTrianglesIsCutOff) {
  for (const bool geographic : {false, true}) {
    Grid grid = slantingSea(56.0);
    if (geographic) grid = inDegrees(grid);
    ASSERT_EQ(kindsIn(grid, Target::Fvcom), testing::Kinds{TargetDefectKind::OpenAndSolid});
    const std::size_t before = grid.triangles.size();
    const RepairReport report = repairForTargets(grid, kFvcom, {.min_angle_deg = kBoundDeg});
    EXPECT_EQ(cutsIn(report), 1);
    EXPECT_EQ(kindsIn(grid, Target::Fvcom), testing::Kinds{});
    EXPECT_EQ(grid.triangles.size(), before - 1);
    EXPECT_EQ(grid.nodes.size(), kRow * kRow - 1);
    EXPECT_GE(leastAngleOf(grid), kBoundDeg);
    // The new edge is shore: all of the open boundary is in the south.
    const auto open = std::ranges::find(grid.boundaries, BoundaryRole::Open, &Boundary::role);
    ASSERT_NE(open, grid.boundaries.end());
    EXPECT_EQ(open->nodes.size(), kRow - 1);
    for (const std::uint32_t node : open->nodes) EXPECT_EQ(grid.nodes[node].y, 0.0);
  }
}

TEST(Corner, WideEnoughForTwoTrianglesIsDivided) {
  Grid grid = slantingSea(70.0);
  const RepairReport report = repairForTargets(grid, kFvcom, {.min_angle_deg = kBoundDeg});
  EXPECT_EQ(cutsIn(report), 0);
  EXPECT_EQ(kindsIn(grid, Target::Fvcom), testing::Kinds{});
  EXPECT_EQ(kindsIn(slantingSea(56.0), Target::Fvcom), testing::Kinds{TargetDefectKind::OpenAndSolid});
  // Without a bound on angles no corner is too sharp.
  Grid sharp = slantingSea(56.0);
  EXPECT_EQ(cutsIn(repairForTargets(sharp, kFvcom)), 0);
  EXPECT_EQ(kindsIn(sharp, Target::Fvcom), testing::Kinds{});
}

// The triangle behind the corner has an open edge, so it would be the next such corner.
TEST(Corner, IsCutOffAsFarAsNeeded) {
  Grid grid = slantingSea(56.0);
  const auto replace = [&grid](GridCorners from, GridCorners to) {
    const auto at = std::ranges::find(grid.triangles, from);
    ASSERT_NE(at, grid.triangles.end());
    *at = to;
  };
  replace({1, 8, 7}, {1, 2, 7});
  replace({1, 2, 8}, {2, 8, 7});
  const std::size_t before = grid.triangles.size();
  const RepairReport report = repairForTargets(grid, kFvcom, {.min_angle_deg = kBoundDeg});
  EXPECT_EQ(cutsIn(report), 1);
  EXPECT_EQ(kindsIn(grid, Target::Fvcom), testing::Kinds{});
  EXPECT_EQ(grid.triangles.size(), before - 2);
}

TEST(Corner, StaysWhereItIsAskedFor) {
  const auto cuts = [](Grid grid, const std::vector<Point>& asked) {
    const RepairReport report = repairForTargets(grid, kFvcom, {.min_angle_deg = kBoundDeg, .asked = asked});
    EXPECT_EQ(kindsIn(grid, Target::Fvcom), testing::Kinds{});
    return cutsIn(report);
  };
  EXPECT_EQ(cuts(slantingSea(56.0), {}), 1);
  EXPECT_EQ(cuts(slantingSea(56.0), {Point{0.0, 0.0}}), 0);
  Grid with_line = slantingSea(56.0);
  with_line.lines = {{LineKind::Weir, "along the shore", false, {0, kRow, 2 * kRow}}};
  EXPECT_EQ(cuts(with_line, {}), 0);
  const Grid with_river = slantingSea(56.0, [](std::uint32_t from, std::uint32_t to) {
    const bool river = std::min(from, to) == 0 && std::max(from, to) == kRow;
    return river ? BoundaryKind{BoundaryRole::River} : openInTheSouth(from, to);
  });
  EXPECT_EQ(cuts(with_river, {}), 0);
}

// Waters of two triangles, each with an open edge: once the edge between them is divided, the second has a new node.
TEST(Corner, MayHaveANodeOfTheSameRound) {
  Grid grid;
  for (std::uint32_t k = 0; k < 100; ++k) {
    const double x = 3000.0 * k;
    grid.nodes.insert(grid.nodes.end(), {{x, 0.0}, {x + 1000.0, 0.0}, {x + 2000.0, 0.0}, {x + 1000.0, 900.0}});
    grid.triangles.push_back({4 * k, 4 * k + 1, 4 * k + 3});
    grid.triangles.push_back({4 * k + 1, 4 * k + 2, 4 * k + 3});
  }
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t from, std::uint32_t to) {
    const bool open = grid.nodes[from].y == 0.0 && grid.nodes[to].y == 0.0;
    return BoundaryKind{open ? BoundaryRole::Open : BoundaryRole::Land};
  });
  ASSERT_EQ(kindsIn(grid, Target::Fvcom), testing::Kinds{TargetDefectKind::OpenAndSolid});
  const RepairReport report = repairForTargets(grid, kFvcom, {.min_angle_deg = kBoundDeg});
  EXPECT_EQ(report.repairs.size(), 100u);
  EXPECT_EQ(kindsIn(grid, Target::Fvcom), testing::Kinds{});
}

// The south-eastern corner of a frame in degrees, with two sides of a triangle on it.
Grid cornerOfFrame() {
  constexpr double kEast = -67.5, kSouth = 16.5;
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{-67.654762, kSouth},    {kEast, kSouth},        {kEast, 16.648276},   {-67.706386, 16.638283},
                {-67.625474, 16.748727}, {kEast, 16.796552},     {-67.809524, kSouth}, {-67.784118, 16.802838},
                {-67.878300, 16.651846}, {-67.627840, 16.873122}};
  grid.triangles = {{0, 1, 2}, {3, 0, 2}, {4, 3, 2}, {3, 6, 0}, {4, 2, 5},
                    {4, 7, 3}, {8, 6, 3}, {7, 8, 3}, {4, 5, 9}, {7, 4, 9}};
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
    const auto on = [&](double Point::*axis, double side) {
      return grid.nodes[a].*axis == side && grid.nodes[b].*axis == side;
    };
    const bool open = on(&Point::x, kEast) || on(&Point::y, kSouth);
    return BoundaryKind{open ? BoundaryRole::Open : BoundaryRole::Land};
  });
  return grid;
}

// FVCOM needs a second triangle in the corner, D-Flow FM flow links that are not too short: with good angles, only
// after a node beside the corner has moved.
TEST(Corner, IsRepairedForSeveralModels) {
  const std::array targets{Target::Fvcom, Target::Dflowfm, Target::Swan};
  Grid grid = cornerOfFrame();
  EXPECT_EQ(kindsIn(grid, Target::Fvcom),
            (testing::Kinds{TargetDefectKind::TwoOpenEdges, TargetDefectKind::OpenBridge}));
  const RepairReport report = repairForTargets(grid, targets);
  EXPECT_EQ(cutsIn(report), 0);
  EXPECT_GE(leastAngleOf(grid), kBoundDeg);
  for (const Target target : targets) EXPECT_EQ(kindsIn(grid, target), testing::Kinds{});
}

}  // namespace
}  // namespace coastmesh
