// Nodes on straight parts of an open boundary slide along it, as do those where a shore meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/quality.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/model/time_step.hpp"
#include "gis/repair/repair_boundaries.hpp"
#include "gis/repair/repair_shore.hpp"
#include "gis/repair/repair_state.hpp"
#include "tests/gis/check/target_samples.hpp"
#include "tests/gis/repair/slanting_sea.hpp"

namespace coastmesh {
namespace {

using testing::openGrid;
using testing::slantingSea;

constexpr double kStep = 48.0;  // needs edges of 690 to 740 m in water of 20 to 23 m

// Metres; with `geographic`, scaled to degrees at the equator.
Grid placed(Grid grid, bool geographic) { return geographic ? testing::inDegrees(std::move(grid)) : grid; }

std::size_t tooShort(const Grid& grid) {
  return static_cast<std::size_t>(std::ranges::count_if(timeSteps(grid), [](double step_s) { return step_s < kStep; }));
}

std::uint32_t nodeAt(const Grid& grid, const Point& place) {
  return static_cast<std::uint32_t>(std::ranges::find(grid.nodes, place) - grid.nodes.begin());
}

Grid squareSea() {
  constexpr std::uint32_t kCells = 5;
  Grid grid = slantingSea(kCells, 90.0, [](std::uint32_t, std::uint32_t) { return BoundaryKind{BoundaryRole::Open}; });
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)  // without rounding
    grid.nodes[node] = {1000.0 * (node % (kCells + 1)), 1000.0 * (node / (kCells + 1))};
  return grid;
}

double areaOf(const Grid& grid) {
  double sum = 0.0;
  for (const auto& [a, b, c] : grid.triangles) {
    const Point &p = grid.nodes[a], &q = grid.nodes[b], &r = grid.nodes[c];
    sum += ((q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y)) / 2.0;
  }
  return sum;
}

TEST(OpenSide, ANodeSlidesAlongItForTheTimeStep) {
  for (const bool geographic : {false, true}) {
    Grid grid = openGrid();
    grid.nodes[nodeAt(grid, {4000.0, 0.0})].x = 4400.0;
    grid = placed(grid, geographic);
    const double area = areaOf(grid);
    ASSERT_GT(tooShort(grid), 0u);
    Grid fixed = grid;
    repairForTargets(fixed, {}, {.time_step_s = kStep});
    EXPECT_GT(tooShort(fixed), 0u);  // unless boundaries may move
    repairForTargets(grid, {}, {.time_step_s = kStep, .shore_moves = true});
    EXPECT_EQ(tooShort(grid), 0u);
    EXPECT_NEAR(areaOf(grid), area, 1e-9 * area);
  }
}

TEST(OpenSide, NodesStayWhereItTurns) {
  Grid grid = openGrid();
  const std::uint32_t node = nodeAt(grid, {4000.0, 0.0});
  grid.nodes[node] = {4400.0, -60.0};
  const Point place = grid.nodes[node];
  repairForTargets(grid, {}, {.time_step_s = kStep, .shore_moves = true});
  EXPECT_LT(nodeAt(grid, place), grid.nodes.size());
}

// Both edges at the corner are too short: no move of one node mends the triangle.
TEST(OpenSide, BothLegsOfACornerAreMadeLonger) {
  for (const bool geographic : {false, true}) {
    Grid grid = squareSea();
    const std::uint32_t south = nodeAt(grid, {1000.0, 0.0}), west = nodeAt(grid, {0.0, 1000.0});
    grid.nodes[south].x = 620.0;
    grid.nodes[west].y = 640.0;
    grid = placed(grid, geographic);
    const double area = areaOf(grid);
    ASSERT_EQ(tooShort(grid), 1u);
    repairForTargets(grid, {}, {.time_step_s = kStep, .shore_moves = true});
    EXPECT_EQ(tooShort(grid), 0u);
    EXPECT_NEAR(areaOf(grid), area, 1e-9 * area);
    EXPECT_EQ(grid.nodes.size(), 36u);
  }
}

constexpr std::uint32_t kSouth = 7;  // nodes in the south, the first ones

Grid seaWithOpenSouth() {
  return slantingSea(kSouth - 1, 56.0, [](std::uint32_t from, std::uint32_t to) {
    return BoundaryKind{from < kSouth && to < kSouth ? BoundaryRole::Open : BoundaryRole::Land};
  });
}

// A second triangle in a corner halves its angle, which must then be wider: the node there slides.
TEST(OpenSide, CornersWidenForASecondTriangle) {
  constexpr double kBoundDeg = 33.0;
  for (const bool geographic : {false, true}) {
    Grid grid = placed(seaWithOpenSouth(), geographic);
    const std::vector<Target> targets{Target::Fesom};
    ASSERT_EQ(checkTarget(grid, Target::Fesom).size(), 2u);
    repairForTargets(grid, targets, {.shore_moves = true, .min_angle_deg = kBoundDeg});
    EXPECT_TRUE(checkTarget(grid, Target::Fesom).empty());
    for (const auto& [a, b, c] : grid.triangles) {
      const auto p = localPlane(grid, std::array{a, b, c});
      EXPECT_GE(leastAngleDeg(p[0], p[1], p[2]), kBoundDeg - 0.02);
    }
    const auto open = std::ranges::find(grid.boundaries, BoundaryRole::Open, &Boundary::role);
    ASSERT_NE(open, grid.boundaries.end());
    for (const std::uint32_t node : open->nodes) EXPECT_NEAR(grid.nodes[node].y, 0.0, 1e-9);
  }
}

// Edges that a short one separates are as close as that is long, on a shore and on a straight side.
TEST(OpenSide, EdgesMayBeCloseAlongTheBoundary) {
  for (const bool geographic : {false, true}) {
    Grid grid = seaWithOpenSouth();
    constexpr std::uint32_t kNorth = 45, kOfSouth = 3;
    for (std::uint32_t node = 42; node < 49; ++node) grid.nodes[node].y += node % 2 * 60.0;
    for (const std::uint32_t node : {kNorth, kOfSouth}) grid.nodes[node].x += 700.0;
    grid = placed(grid, geographic);
    RepairState state{.grid = grid, .targets = {}, .options = {.shore_moves = true}};
    startRepairs(state, nullptr);
    state.links.kinds = takeBoundaryKinds(grid, linkGrid(grid).mesh);
    startRound(state);
    const RepairView view = state.view();
    for (const std::uint32_t node : {kNorth, kOfSouth})
      for (const double share : {0.001, 0.1, 0.5})
        EXPECT_TRUE(view.shores->keepsApart(view, moveOf(view, node, node + 1, node + 1, share)))
            << node << ' ' << share;
  }
}

}  // namespace
}  // namespace coastmesh
