#include "gis/merge/frame_sides.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "gis/merge/merge_grids.hpp"
#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

using Height = std::function<double(const Point&)>;

// Sea in the west, and a plain that rises to the east.
double plain(const Point& p) { return p.x - 8.0; }
double sea(const Point&) { return -5.0; }

void setHeights(Grid& grid, const Height& height) {
  for (std::size_t v = 0; v < grid.nodes.size(); ++v) grid.z[v] = height(grid.nodes[v]);
}

Grid outerWith(const Height& height) {
  Grid grid = gridOf({20, 20});
  setHeights(grid, height);
  return grid;
}

// A mesh of these squares, open at its frame's sides in the west of 8 and with shores elsewhere.
Grid nestWith(const Squares& squares, const Height& height) {
  Grid nest = gridOf(squares);
  setHeights(nest, height);
  openWhere(nest, [](const Point& p) { return p.x < 8.0; });
  return nest;
}
const Squares kFrame{20, 12, 0.5, {4.2, 6.3}};
// Of its 64 edges, those in the north and south from 8.2 on, and in the east.
constexpr std::size_t kOnLand = 12 + 12 + 12;

MergeReport mergeAndCheck(Grid& grid, const Grid& nest) {
  const Grid before = grid;
  const MergeReport report = mergeGrids(grid, Grid(nest));
  expectMerged(before, nest, grid, report.nodes, report.triangles);
  return report;
}

TEST(FrameSides, AcrossAPlainAreJoined) {
  for (const double turn : {0.0, 0.3}) {
    SCOPED_TRACE(turn);
    Squares frame = kFrame;
    frame.turn = turn;
    Grid grid = outerWith(plain);
    const Grid before = grid;
    const MergeReport report = mergeAndCheck(grid, nestWith(frame, plain));
    EXPECT_EQ(report.joined, 64u);
    EXPECT_GT(report.joined_land, 30u);
    if (turn == 0.0) {
      EXPECT_EQ(report.joined_land, kOnLand);
    }
    EXPECT_EQ(report.closed.length_m, 0.0);
    EXPECT_NEAR(areaOf(grid), 400.0, 1e-9);
    EXPECT_EQ(shoresOf(grid), shoresOf(before));
  }
}

TEST(FrameSides, AnywhereInAPlainAreJoined) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::size_t joined_land = 0;
  for (int run = 0; run < 60; ++run) {
    SCOPED_TRACE(run);
    Squares frame;
    frame.length = 0.2 + 0.8 * share(random);
    frame.columns = 4 + static_cast<int>(4.0 * share(random) / frame.length);
    frame.rows = 4 + static_cast<int>(4.0 * share(random) / frame.length);
    frame.turn = 2.0 * std::numbers::pi * share(random);
    frame.corner = {9.0 + 2.0 * share(random), 9.0 + 2.0 * share(random)};
    Grid grid = outerWith(plain);
    const MergeReport report = mergeAndCheck(grid, nestWith(frame, plain));
    // But for a single edge beside the end of the other mesh.
    EXPECT_GE(report.joined + 1, 2u * static_cast<unsigned>(frame.columns + frame.rows));
    EXPECT_EQ(report.closed.length_m, 0.0);
    EXPECT_NEAR(areaOf(grid), 400.0, 1.0);
    joined_land += report.joined_land;
  }
  EXPECT_GT(joined_land, 300u);
}

TEST(FrameSides, WithoutLandInBothAreNamed) {
  const auto noHeights = [](const Point&) { return std::numeric_limits<double>::quiet_NaN(); };
  const std::vector<std::pair<Height, Height>> heights{
      {sea, sea}, {plain, sea}, {sea, plain}, {noHeights, noHeights}, {plain, noHeights}};
  for (const auto& [of_grid, of_nest] : heights) {
    Grid grid = outerWith(of_grid);
    Grid nest = nestWith(kFrame, of_nest);
    // Unknown heights compare unequal.
    const MergeReport report = mergeGrids(grid, Grid(nest));
    EXPECT_EQ(report.joined_land, 0u);
    EXPECT_EQ(report.joined, 64u - kOnLand);
    EXPECT_NEAR(report.closed.length_m, 0.5 * kOnLand, 1e-9);
    EXPECT_GT(report.closed.place.x, 8.0);
    EXPECT_LT(areaOf(grid), 395.0);
  }
  Grid grid = outerWith(plain), nest = nestWith(kFrame, plain);
  grid.z.clear();
  nest.z.clear();
  EXPECT_NEAR(mergeAndCheck(grid, nest).closed.length_m, 0.5 * kOnLand, 1e-9);
}

TEST(FrameSides, ShortPartsThatOnlyTheNestHasOnLandAreJoined) {
  // A ridge at the nest's west side, which is open elsewhere, narrower than the other mesh shows.
  for (const double width : {0.5, 1.5, 2.5, 3.5}) {
    SCOPED_TRACE(width);
    const auto onRidge = [&](const Point& p) { return p.x < 5.0 && std::abs(p.y - 9.55) < 0.5 * width + 0.01; };
    const auto ridge = [&](const Point& p) { return onRidge(p) ? 0.5 : -5.0; };
    Grid grid = outerWith(sea);
    const Grid before = grid;
    Grid nest = gridOf(kFrame);
    setHeights(nest, ridge);
    openWhere(nest, [&](const Point& p) { return !onRidge(p); });
    const auto on_ridge = static_cast<std::size_t>(std::lround(width / kFrame.length));
    const bool is_short = width < 2.0 * std::numbers::sqrt2;
    const MergeReport report = mergeAndCheck(grid, nest);
    EXPECT_EQ(report.joined_land, is_short ? on_ridge : 0u);
    EXPECT_EQ(report.joined, is_short ? 64u : 64u - on_ridge);
    EXPECT_NEAR(report.closed.length_m, is_short ? 0.0 : width, 1e-9);
    EXPECT_EQ(shoresOf(grid) == shoresOf(before), is_short);
  }
}

TEST(FrameSides, AnEndOfTheOtherMeshIsNone) {
  // Its shore is within an edge of the nest's east side, or on it, or the nest reaches beyond: a coast of both.
  for (const double x : {9.3, 9.7, 10.0, 11.3}) {
    SCOPED_TRACE(x);
    Squares frame = kFrame;
    frame.corner.x = x;
    Grid grid = outerWith([](const Point& p) { return p.x - 15.0; });
    Grid nest = gridOf(frame);
    setHeights(nest, [](const Point& p) { return p.x - 15.0; });
    openWhere(nest, [&](const Point& p) { return p.x < x + 9.9; });
    const std::set<std::array<double, 4>> coast = shoresOf(nest);
    ASSERT_EQ(coast.size(), 12u);
    const MergeReport report = mergeAndCheck(grid, nest);
    EXPECT_EQ(report.joined_land, 0u);
    EXPECT_EQ(report.closed.length_m, 0.0);
    EXPECT_TRUE(std::ranges::includes(shoresOf(grid), coast));
  }
}

TEST(FrameSides, OnSidesOfTheOtherFrameStayAsTheyAre) {
  // Both end in the north and east at the same lines, with different nodes there.
  for (const BoundaryRole role : {BoundaryRole::Land, BoundaryRole::Open}) {
    const auto isRim = [](const Point& p) { return p.x > 19.9 || p.y > 19.9; };
    Grid grid = outerWith(plain);
    openWhere(grid, [&](const Point& p) { return role == BoundaryRole::Open && isRim(p); });
    Grid nest = gridOf({12, 10, 0.75, {11.0, 12.5}});
    setHeights(nest, plain);
    openWhere(nest, [&](const Point& p) { return role == BoundaryRole::Open || !isRim(p); });
    const MergeReport report = mergeAndCheck(grid, nest);
    EXPECT_EQ(report.joined, 22u);
    EXPECT_EQ(report.joined_land, 0u);
    EXPECT_EQ(report.closed.length_m, 0.0);
    EXPECT_NEAR(areaOf(grid), 400.0, 1.0);
    std::size_t of_role = 0;
    for (const std::array<double, 4>& edge : role == BoundaryRole::Land ? shoresOf(grid) : openOf(grid))
      of_role += isRim({0.5 * (edge[0] + edge[2]), 0.5 * (edge[1] + edge[3])});
    EXPECT_GE(of_role, 22u + 9u + 10u);
  }
}

TEST(FrameSides, AShoreStaysAShore) {
  // The nest's east ends in teeth, beyond which the other mesh has land too: a shore that only that one has not.
  Squares frame = kFrame;
  frame.wanted = [](int column, int row) { return column < 17 || (column < 19 && row % 2 == 0) || row == 0; };
  Grid grid = outerWith(plain);
  const Grid nest = nestWith(frame, plain);
  const MergeReport report = mergeAndCheck(grid, nest);
  EXPECT_GT(report.joined_land, 16u);
  EXPECT_LT(report.joined_land, 24u);  // in the north and south
  EXPECT_GT(report.closed.length_m, 12.0);
  EXPECT_GT(report.closed.place.x, 12.0);
  std::size_t teeth = 0;
  for (const std::array<double, 4>& edge : shoresOf(grid))
    if (edge[0] > 12.0 && edge[0] < 14.0 && edge[1] > 7.0 && edge[1] < 12.0) ++teeth;
  EXPECT_EQ(teeth, 30u);
}

TEST(FrameSides, AStraightShoreWithinTheFrameStays) {
  // A corner of the nest is not in it: its two sides there are straight, but not of the frame's outline.
  Squares frame = kFrame;
  frame.wanted = [](int column, int row) { return column < 14 || row < 6; };
  Grid grid = outerWith(plain);
  const MergeReport report = mergeAndCheck(grid, nestWith(frame, plain));
  EXPECT_EQ(report.joined_land, kOnLand - 12u);
  EXPECT_NEAR(report.closed.length_m, 6.0, 1e-9);
  EXPECT_LT(areaOf(grid), 400.0);
}

TEST(FrameSides, ACoastAtTheOtherMeshsPlainIsNamed) {
  // Only the other mesh has a plain: the nest ends at its coast, whose nodes happen to be above the water.
  Squares frame = kFrame;
  Grid grid = outerWith(plain);
  const Grid nest = nestWith(frame, [](const Point& p) { return p.x > 13.9 ? 0.5 : -5.0; });
  const MergeReport report = mergeAndCheck(grid, nest);
  EXPECT_EQ(report.joined_land, 0u);
  EXPECT_NEAR(report.closed.length_m, 0.5 * kOnLand, 1e-9);
}

TEST(FrameSides, RiversAndWeirsStay) {
  for (const bool river : {true, false}) {
    Grid grid = outerWith(plain);
    Grid nest = nestWith(kFrame, plain);
    Boundary east{river ? BoundaryRole::River : BoundaryRole::Land, false, {}};
    for (Boundary& boundary : nest.boundaries) {
      if (boundary.role != BoundaryRole::Land) continue;
      std::vector<std::uint32_t> before, after;
      for (const std::uint32_t node : boundary.nodes) {
        const Point& p = nest.nodes[node];
        if (p.x > 14.1) {
          east.nodes.push_back(node);
        } else {
          (east.nodes.empty() ? before : after).push_back(node);
        }
      }
      before.push_back(east.nodes.front());
      after.insert(after.begin(), east.nodes.back());
      boundary.nodes = before;
      nest.boundaries.push_back({BoundaryRole::Land, false, after});
      break;
    }
    ASSERT_EQ(east.nodes.size(), 13u);
    east.ibtype = river ? 22 : 3;
    if (!river) east.weir.assign(2 * east.nodes.size(), 6.0);  // height and coefficient
    nest.boundaries.push_back(east);
    const MergeReport report = mergeAndCheck(grid, nest);
    EXPECT_EQ(report.joined_land, kOnLand - 12u);
    EXPECT_EQ(report.closed.length_m, 0.0);
    EXPECT_EQ(std::ranges::count_if(grid.boundaries, [&](const Boundary& b) { return b.ibtype == east.ibtype; }), 1);
  }
}

}  // namespace
}  // namespace coastmesh
