// Nodes that the user requested stay where they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/metric.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "tests/gis/check/target_samples.hpp"

namespace coastmesh {
namespace {

using testing::soundGrid;

// A sea with interior nodes moved so far that many triangles miss a time step of `kStep`; if `geographic`, across 180.
constexpr double kStep = 45.0;
Grid shakenSea(unsigned seed, bool geographic) {
  Grid grid = soundGrid();
  std::vector<bool> on_boundary(grid.nodes.size(), false);
  for (const Boundary& boundary : grid.boundaries)
    for (const std::uint32_t node : boundary.nodes) on_boundary[node] = true;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-300.0, 300.0);
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
    if (!on_boundary[node]) grid.nodes[node] = grid.nodes[node] + Point{shift(random), shift(random)};
  if (!geographic) return grid;
  grid.crs = wgs84();
  for (Point& p : grid.nodes) p = {(p.x > 1000.0 ? -180.0 : 180.0) + (p.x - 1000.0) * 1e-5, p.y * 1e-5};
  return grid;
}

std::size_t countThere(const Grid& grid, const std::vector<Point>& places) {
  return static_cast<std::size_t>(std::ranges::count_if(
      places, [&grid](const Point& place) { return std::ranges::find(grid.nodes, place) != grid.nodes.end(); }));
}

TEST(AskedNodes, StayInRepairsForTheTimeStep) {
  for (const bool geographic : {false, true}) {
    std::size_t repairs = 0, moved_unless_asked = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
      const Grid given = shakenSea(seed, geographic);
      for (const bool asks : {false, true}) {
        RepairOptions options{.time_step_s = kStep, .shore_moves = true};
        std::vector<Point> places;
        for (std::size_t node = 0; node < given.nodes.size(); node += 2) places.push_back(given.nodes[node]);
        if (asks) options.asked = places;
        Grid grid = given;
        const RepairReport report = repairForTargets(grid, {}, options);
        if (asks) {
          repairs += report.repairs.size();
          EXPECT_EQ(countThere(grid, places), places.size());
        } else {
          moved_unless_asked += places.size() - countThere(grid, places);
        }
      }
    }
    EXPECT_GT(repairs, 20u);
    EXPECT_GT(moved_unless_asked, 10u);
  }
}

// SWAN rejects an inner node of three triangles, which repairs remove unless it was requested.
TEST(AskedNodes, StayThoughTheyHaveTooFewTriangles) {
  for (const bool asks : {false, true}) {
    Grid grid = soundGrid();
    const auto middle = static_cast<std::uint32_t>(grid.triangles.size() / 2);
    const auto [a, b, c] = grid.triangles[middle];
    const std::uint32_t node = addNode(grid, middleOf(grid, middle));
    const Point place = grid.nodes[node];
    grid.z[node] = grid.z[a];
    grid.triangles[middle] = {a, b, node};
    copyTriangle(grid, middle, {b, c, node});
    copyTriangle(grid, middle, {c, a, node});
    ASSERT_TRUE(testing::kindsIn(grid, Target::Swan).contains(TargetDefectKind::Valence));
    RepairOptions options;
    if (asks) options.asked = {place};
    const RepairReport report = repairForTargets(grid, std::array{Target::Swan}, options);
    EXPECT_FALSE(report.repairs.empty());
    EXPECT_TRUE(report.left.empty());
    EXPECT_EQ(countThere(grid, {place}), asks ? 1u : 0u);
  }
}

// A folded mesh is unfolded by moves of nodes.
TEST(AskedNodes, StayWhereTheMeshIsFolded) {
  Grid folded = soundGrid();
  std::vector<bool> on_boundary(folded.nodes.size(), false);
  for (const Boundary& boundary : folded.boundaries)
    for (const std::uint32_t node : boundary.nodes) on_boundary[node] = true;
  const auto inner = static_cast<std::size_t>(std::ranges::find(on_boundary, false) - on_boundary.begin());
  folded.nodes[inner] = folded.nodes[inner] + Point{1400.0, 0.0};
  const Point place = folded.nodes[inner];
  for (const bool asks : {false, true}) {
    Grid grid = folded;
    RepairOptions options;
    if (asks) options.asked = {place};
    repairForTargets(grid, std::array{Target::Adcirc}, options);
    EXPECT_EQ(countThere(grid, {place}), asks ? 1u : 0u);
  }
}

}  // namespace
}  // namespace coastmesh
