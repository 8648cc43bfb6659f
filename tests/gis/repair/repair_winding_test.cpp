// Triangles that are clockwise, folded over one another or listed more than once.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/bulk_list.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/repair/repair_target.hpp"
#include "tests/gis/check/target_samples.hpp"

namespace coastmesh {
namespace {

using testing::expectMended;
using testing::kAll;
using testing::Kinds;
using testing::kindsIn;
using testing::soundGrid;

TEST(RepairWinding, Clockwise) {
  Grid grid = soundGrid();
  for (auto& corners : grid.triangles) std::swap(corners[0], corners[1]);
  for (const Target target : kAll) EXPECT_TRUE(kindsIn(grid, target).contains(TargetDefectKind::Clockwise));
  expectMended(grid, {Target::Adcirc, Target::Swan});
}

// One triangle is listed clockwise, but lies beside its neighbours.
TEST(RepairWinding, ATriangleListedClockwise) {
  Grid grid = soundGrid();
  std::swap(grid.triangles[40][0], grid.triangles[40][1]);
  expectMended(grid, {Target::Adcirc});
}

// Areas of a file of another program are negative where triangles are clockwise.
TEST(RepairWinding, TheAreaOfATurnedTriangleIsMeasuredAnew) {
  Grid grid = soundGrid();
  grid.area_m2.assign(grid.triangles.size(), 433000.0);
  std::swap(grid.triangles[40][0], grid.triangles[40][1]);
  grid.area_m2[40] *= -1.0;
  repairForTargets(grid, std::array{Target::Adcirc});
  EXPECT_NEAR(grid.area_m2[40], 433000.0, 1.0);
}

std::uint32_t nodeAt(const Grid& grid, const Point& place) {
  return static_cast<std::uint32_t>(std::ranges::find(grid.nodes, place) - grid.nodes.begin());
}

// An inner node dragged across its neighbours, a little or far: reversing the clockwise triangles would leave overlaps.
TEST(RepairWinding, AFoldIsUndoneByAMoveOfTheNode) {
  for (const Point& drag : {Point{1600.0, 300.0}, Point{2300.0, 400.0}, Point{-900.0, -900.0}, Point{9000.0, 0.0}}) {
    Grid grid = soundGrid();
    const std::uint32_t node = nodeAt(grid, {1000.0 * 3 - 500.0 * 2, 866.0 * 2});
    ASSERT_LT(node, grid.nodes.size());
    const std::size_t triangles = grid.triangles.size(), nodes = grid.nodes.size();
    grid.nodes[node].x += drag.x;
    grid.nodes[node].y += drag.y;
    ASSERT_TRUE(kindsIn(grid, Target::Adcirc).contains(TargetDefectKind::Clockwise));
    const RepairReport report = repairForTargets(grid, std::array{Target::Adcirc});
    EXPECT_TRUE(report.left.empty());
    ASSERT_EQ(report.repairs.size(), 1u);
    EXPECT_EQ(report.repairs[0].what, "node moved");
    EXPECT_EQ(grid.triangles.size(), triangles);
    EXPECT_EQ(grid.nodes.size(), nodes);
    EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{});
  }
}

// Nodes of the shore do not move.
TEST(RepairWinding, AFoldOfTheShoreIsLeft) {
  Grid grid = soundGrid();
  const std::uint32_t node = nodeAt(grid, {4000.0, 0.0});
  ASSERT_LT(node, grid.nodes.size());
  grid.nodes[node].y = 2200.0;
  const BulkList<GridCorners> before = grid.triangles;
  const RepairReport report = repairForTargets(grid, std::array{Target::Adcirc});
  EXPECT_TRUE(report.repairs.empty());
  EXPECT_EQ(grid.triangles, before);
  EXPECT_TRUE(std::ranges::any_of(report.left,
                                  [](const auto& left) { return left.second.kind == TargetDefectKind::Clockwise; }));
}

TEST(RepairWinding, SheetsOverOneAnotherAreLeft) {
  Grid grid = soundGrid(), other = soundGrid();
  for (Point& p : other.nodes) p = {p.x + 700.0, p.y + 500.0};
  appendGrid(grid, std::move(other));
  for (const Target target : kAll) EXPECT_TRUE(kindsIn(grid, target).contains(TargetDefectKind::Overlap));
  const RepairReport report = repairForTargets(grid, std::array{Target::Adcirc});
  ASSERT_FALSE(report.left.empty());
  EXPECT_EQ(report.left.back().second.kind, TargetDefectKind::Overlap);
}

// Listed two or three times, in either direction: one copy remains, and no area is lost.
TEST(RepairWinding, CopiesOfATriangleGo) {
  for (const bool turned : {false, true}) {
    Grid grid = soundGrid();
    const BulkList<GridCorners> before = grid.triangles;
    for (const std::size_t t : {20u, 20u, 0u}) {
      GridCorners copy = grid.triangles[t];
      if (turned) std::swap(copy[0], copy[1]);
      grid.triangles.push_back(copy);
    }
    const RepairReport report = repairForTargets(grid, std::array{Target::Adcirc});
    EXPECT_TRUE(report.left.empty());
    EXPECT_EQ(report.repairs.size(), 3u);
    EXPECT_EQ(grid.triangles, before);
    EXPECT_EQ(kindsIn(grid, Target::Adcirc), Kinds{});
  }
}

}  // namespace
}  // namespace coastmesh
