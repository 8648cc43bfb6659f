// Nodes on straight parts of an open boundary slide along it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gis/model/time_step.hpp"
#include "tests/gis/model/target_samples.hpp"

namespace coastmesh {
namespace {

using testing::openGrid;

constexpr double kStep = 48.0;  // needs edges of 690 to 740 m in water of 20 to 23 m

// Metres; with `geographic`, scaled to degrees at the equator.
Grid placed(Grid grid, bool geographic) {
  if (!geographic) return grid;
  grid.crs = wgs84();
  for (Point& p : grid.nodes) p = {p.x / 111319.5, p.y / 110574.3};
  return grid;
}

std::size_t tooShort(const Grid& grid) {
  return static_cast<std::size_t>(std::ranges::count_if(timeSteps(grid), [](double step_s) { return step_s < kStep; }));
}

std::uint32_t nodeAt(const Grid& grid, const Point& place) {
  return static_cast<std::uint32_t>(std::ranges::find(grid.nodes, place) - grid.nodes.begin());
}

// An open sea of squares, each cut from north-west to south-east: the south-western corner is one triangle.
Grid squareSea() {
  constexpr std::uint32_t kCells = 5, kRow = kCells + 1;
  Grid grid;
  for (std::uint32_t j = 0; j < kRow; ++j)
    for (std::uint32_t i = 0; i < kRow; ++i) grid.nodes.push_back({1000.0 * i, 1000.0 * j});
  for (std::uint32_t j = 0; j < kCells; ++j) {
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t sw = j * kRow + i, se = sw + 1, nw = sw + kRow, ne = nw + 1;
      grid.triangles.push_back({sw, se, nw});
      grid.triangles.push_back({se, ne, nw});
    }
  }
  grid.z.assign(grid.nodes.size(), -20.0);
  const auto loops = boundaryLoops(grid);
  grid.boundaries =
      cutLoops(grid, loops, [](std::uint32_t, std::uint32_t) { return BoundaryKind{BoundaryRole::Open}; });
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

}  // namespace
}  // namespace coastmesh
