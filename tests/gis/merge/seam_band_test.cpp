#include "gis/merge/seam_band.hpp"

#include <gtest/gtest.h>

#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

std::size_t gapAndAround(const Grid& grid, const MergeReport& merged) {
  std::set<std::uint32_t> nodes;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    if (merged.triangles[t].mesh == kNone) nodes.insert(grid.triangles[t].begin(), grid.triangles[t].end());
  std::size_t count = 0;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    if (merged.triangles[t].mesh != 1 &&
        std::ranges::any_of(grid.triangles[t], [&](std::uint32_t node) { return nodes.contains(node); }))
      ++count;
  return count;
}

TEST(SeamBand, OfMeshesAlikeIsTheGapAndWhatIsAroundIt) {
  Grid grid = gridOf({20, 20});
  const MergeReport merged = mergeGrids(grid, gridOf({5, 5, 1.0, {7.3, 6.4}, 0.3}, BoundaryRole::Open));
  const SeamBand band = seamBand(grid, merged, 0.2);
  EXPECT_EQ(band.triangles, gapAndAround(grid, merged));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(band.taken, 1)), band.triangles);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    if (merged.triangles[t].mesh == 1) {
      EXPECT_EQ(band.taken[t], 0);
    }
  }
}

TEST(SeamBand, IsAsWideAsSizesDiffer) {
  const auto widthFor = [](double length, double gradation) {
    Grid grid = gridOf({60, 60});
    const int cells = static_cast<int>(10.0 / length);
    const MergeReport merged = mergeGrids(grid, gridOf({cells, cells, length, {25.0, 25.0}}, BoundaryRole::Open));
    const SeamBand band = seamBand(grid, merged, gradation);
    EXPECT_NEAR(band.largest, 1.14, 0.02);
    double width = 0.0;  // west of the inserted mesh
    for (std::size_t t = 0; t < grid.triangles.size(); ++t)
      if (band.taken[t] != 0)
        for (const std::uint32_t node : grid.triangles[t]) width = std::max(width, 25.0 - grid.nodes[node].x);
    return width;
  };
  const double narrow = widthFor(0.2, 0.4), wide = widthFor(0.2, 0.1), alike = widthFor(0.8, 0.1);
  // Along edges, sizes grow from 0.23 to 1.14 over 0.9 / 0.1; less what needs no transition, and the last triangle.
  EXPECT_GT(wide, 5.0);
  EXPECT_LT(wide, 10.0);
  EXPECT_LT(narrow, 0.5 * wide);
  EXPECT_LT(alike, 3.0);
}

TEST(SeamBand, IsNothingWhereMeshesFit) {
  // Columns are twice as wide as the one before, which is more than a seam may have.
  const auto grown = [](Grid grid) {
    for (Point& p : grid.nodes) p.x = std::pow(2.0, p.x);
    return grid;
  };
  Grid grid = grown(gridOf({10, 10, 1.0, {}, 0.0, [](int x, int) { return x < 5; }}));
  const Grid part = grown(gridOf({10, 10, 1.0, {}, 0.0, [](int x, int) { return x >= 5; }}, BoundaryRole::Open));
  const MergeReport merged = mergeGrids(grid, Grid(part));
  ASSERT_EQ(merged.gap, 0u);
  EXPECT_EQ(merged.united, 11u);
  EXPECT_EQ(std::ranges::count(merged.of_both, 1), 11);
  EXPECT_EQ(seamBand(grid, merged, 0.001).triangles, 0u);
}

}  // namespace
}  // namespace coastmesh
