#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/repair/repair_boundaries.hpp"
#include "gis/repair/repair_shape.hpp"
#include "tests/gis/check/target_samples.hpp"

namespace coastmesh {
namespace {

using testing::soundGrid;

constexpr double kBoundDeg = 40.0;

// A lattice of equilateral triangles with its interior nodes moved.
Grid shakenGrid(unsigned seed, double by_m, bool geographic) {
  Grid grid = soundGrid();
  std::vector<bool> on_boundary(grid.nodes.size(), false);
  for (const Boundary& boundary : grid.boundaries)
    for (const std::uint32_t node : boundary.nodes) on_boundary[node] = true;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-by_m, by_m);
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
    if (!on_boundary[node]) grid.nodes[node] = grid.nodes[node] + Point{shift(random), shift(random)};
  if (!geographic) return grid;
  grid.crs = wgs84();
  for (Point& p : grid.nodes) p = {p.x * 1e-5, p.y * 1e-5};
  return grid;
}

std::vector<std::uint32_t> smallIn(const Grid& grid) {
  std::vector<std::uint32_t> small;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& [a, b, c] = grid.triangles[t];
    EXPECT_GT(orient2d(grid.nodes[a], grid.nodes[b], grid.nodes[c]), 0);
    if (leastAngleDeg(grid.nodes[a], grid.nodes[b], grid.nodes[c]) < kBoundDeg - 0.02) small.push_back(t);
  }
  return small;
}

TEST(ShareSmallAngle, TrianglesAroundGiveUpWhatTheyHaveAboveTheBound) {
  std::size_t before = 0, after = 0;
  for (const bool geographic : {false, true}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Grid grid = shakenGrid(seed, 180.0, geographic);
      const Grid given = grid;
      RepairState state{.grid = grid, .targets = {}, .options = {.min_angle_deg = kBoundDeg}};
      startRepairs(state, nullptr);
      state.links.kinds = takeBoundaryKinds(grid, linkGrid(grid).mesh);
      startRound(state);
      const std::vector<std::uint32_t> small = smallIn(grid);
      before += small.size();
      std::size_t left = small.size();
      for (const std::uint32_t t : small) {
        shareSmallAngle(state, t);
        const std::size_t now = smallIn(grid).size();
        EXPECT_LE(now, left);
        left = now;
      }
      after += left;
      EXPECT_EQ(grid.triangles, given.triangles);
      for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
        EXPECT_TRUE(!state.links.on_boundary[node] || grid.nodes[node] == given.nodes[node]);
    }
  }
  EXPECT_GT(before, 40u);
  EXPECT_LE(after, before / 20);
}

}  // namespace
}  // namespace coastmesh
