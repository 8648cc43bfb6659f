// Repairs avoid edges shorter than a bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "gis/crs/geodesy.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/repair/repair_boundaries.hpp"
#include "gis/repair/repair_score.hpp"
#include "gis/repair/repair_state.hpp"
#include "gis/repair/repair_target.hpp"
#include "tests/gis/repair/slanting_sea.hpp"

namespace coastmesh {
namespace {

using testing::inDegrees;
using testing::slantingSea;

constexpr std::array kFesom{Target::Fesom};

// Two of its corners are one triangle each.
Grid sea(BoundaryRole role, std::uint32_t cells = 5) {
  return slantingSea(cells, 56.0, [role](std::uint32_t, std::uint32_t) { return BoundaryKind{role}; });
}

double shortestEdge(const Grid& grid) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::array<double, 3>& lengths : edgeLengths(grid.nodes, grid.triangles, grid.crs))
    shortest = std::min(shortest, std::ranges::min(lengths));
  return shortest;
}

std::set<std::string> repaired(Grid& grid, const RepairOptions& options) {
  std::set<std::string> what;
  const RepairReport report = repairForTargets(grid, kFesom, options);
  for (const Repair& repair : report.repairs) what.insert(repair.what);
  EXPECT_TRUE(report.left.empty());
  EXPECT_TRUE(checkTarget(grid, Target::Fesom).empty());
  return what;
}

TEST(ShortEdges, FesomsCornersAreCutOffInsteadOfSplit) {
  for (const bool geographic : {false, true}) {
    const Grid whole = geographic ? inDegrees(sea(BoundaryRole::Land)) : sea(BoundaryRole::Land);
    Grid grid = whole;
    EXPECT_EQ(repaired(grid, {.shore_moves = true, .min_angle_deg = 33.0}), std::set<std::string>{"corner cut off"});
    EXPECT_GT(shortestEdge(grid), 900.0);
    EXPECT_EQ(grid.triangles.size(), whole.triangles.size() - 2);
    EXPECT_EQ(grid.nodes.size(), whole.nodes.size() - 2);
  }
}

// The corners of a frame stay, as does a shore that must not move: edges are flipped rather than made too short.
TEST(ShortEdges, OtherCornersStay) {
  for (const bool open : {false, true}) {
    const Grid whole = sea(open ? BoundaryRole::Open : BoundaryRole::Land);
    RepairOptions options{.shore_moves = open, .min_angle_deg = 33.0};
    options.least_edge_m = 700.0;
    Grid grid = whole;
    EXPECT_FALSE(repaired(grid, options).contains("corner cut off"));
    EXPECT_GT(shortestEdge(grid), 700.0);
    EXPECT_EQ(std::ranges::count(grid.nodes, whole.nodes.front()), 1);
  }
}

// At the end of a water one element wide, the triangle behind a corner would be the next corner.
TEST(ShortEdges, TheEndOfANarrowWaterIsCutOffAsAWhole) {
  Grid grid = sea(BoundaryRole::Land, 8);
  // A row of four triangles in the east, from the middle of that side on.
  const auto nodes = static_cast<std::uint32_t>(grid.nodes.size());
  const std::uint32_t south = 4 * 9 + 8, north = south + 9;
  const Point along{1000.0, 0.0};
  for (const double steps : {1.0, 2.0}) {
    grid.nodes.push_back(grid.nodes[south] + steps * along);
    grid.nodes.push_back(grid.nodes[north] + steps * along);
  }
  grid.triangles.push_back({south, nodes, north});
  grid.triangles.push_back({nodes, nodes + 1, north});
  grid.triangles.push_back({nodes, nodes + 2, nodes + 1});
  grid.triangles.push_back({nodes + 2, nodes + 3, nodes + 1});
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.boundaries = cutLoops(grid, boundaryLoops(grid),
                             [](std::uint32_t, std::uint32_t) { return BoundaryKind{BoundaryRole::Land}; });
  const std::size_t triangles = grid.triangles.size();
  const RepairOptions options{.shore_moves = true, .min_angle_deg = 33.0};
  EXPECT_EQ(repaired(grid, options), std::set<std::string>{"corner cut off"});
  EXPECT_EQ(grid.triangles.size(), triangles - 4 - 2);
}

TEST(ShortEdges, AreCountedByScores) {
  Grid grid = sea(BoundaryRole::Land);
  RepairState state{.grid = grid, .targets = kFesom, .options = {.least_edge_m = 700.0}};
  startRepairs(state, nullptr);
  state.links.kinds = takeBoundaryKinds(grid, linkGrid(grid).mesh);
  startRound(state);
  const RepairView view = state.view();
  const std::array<std::uint32_t, 1> first{0};
  const GridPatch patch = patchRound(view, first);
  const PatchScale scale = scaleOf(view, patch);
  const auto& [a, b, c] = grid.triangles[0];
  // An inner edge of some 900 m, in four triangles.
  EXPECT_EQ(scoreOf(view, patch, scale, splitOf(view, patch, b, c, 0.5)).short_added, 4);
  EXPECT_EQ(scoreOf(view, patch, scale, *flipOf(view, patch, b, c)).short_added, 0);
}

// An edit that makes edges too short is as good as one with angles of 20 degrees.
TEST(ShortEdges, ComeLast) {
  const EditScore good{-1, 34.0}, sharp{-1, 26.0}, bad{-1, 12.0};
  EditScore short_one{-1, 40.0};
  short_one.short_added = 2;
  EXPECT_TRUE(good.betterThan(short_one));
  EXPECT_TRUE(sharp.betterThan(short_one));
  EXPECT_TRUE(short_one.betterThan(bad));
  ScoreBar bar;
  EXPECT_TRUE(bar.isReachedBy(short_one));
  bar.short_added = 0;
  EXPECT_FALSE(bar.isReachedBy(short_one));
}

}  // namespace
}  // namespace coastmesh
