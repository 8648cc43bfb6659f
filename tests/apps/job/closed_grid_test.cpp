// Grids of the whole globe: in any plane one triangle would be turned over.
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/job/check_grid.hpp"
#include "apps/report/file_info.hpp"
#include "tests/gis/globe_samples.hpp"

namespace coastmesh {
namespace {

Grid wholeGlobe(double turned_deg) {
  Grid grid = testing::octahedralGlobe(4, [](const auto&) { return true; });
  for (Point& node : grid.nodes) {
    node.x += turned_deg;
    if (node.x > 180.0) node.x -= 360.0;
  }
  return grid;
}

GridCheck checkBound(const Grid& grid, double min_angle_deg) {
  GridCheckOptions options;
  options.min_angle_deg = min_angle_deg;
  options.delaunay = true;
  options.pinches = true;
  return checkGrid(grid, options);
}

TEST(ClosedGrid, IsMeasuredOnTheEllipsoid) {
  for (const double turned : {0.0, 31.0, 122.5}) {
    const Grid grid = wholeGlobe(turned);
    const MeshInfo info = describeMesh(grid);
    EXPECT_EQ(info.surface, "ellipsoid");
    EXPECT_NEAR(info.area_m2, 5.10065621724e14, 1e-9 * info.area_m2);
    EXPECT_LT(info.quality.area, info.area_m2);
    EXPECT_GT(info.quality.area, 0.99 * info.area_m2);
    EXPECT_TRUE(checkBound(grid, info.quality.min_angle_deg).defects.empty());
    const GridCheck sharper = checkBound(grid, info.quality.min_angle_deg + 0.1);
    EXPECT_FALSE(sharper.defects.empty());
    EXPECT_TRUE(std::ranges::all_of(
        sharper.defects, [](const GridDefect& defect) { return defect.kind == DefectKind::AngleBelowBound; }));
  }
}

TEST(ClosedGrid, TurnedTrianglesAreFound) {
  Grid grid = wholeGlobe(10.0);
  for (auto& corners : grid.triangles) std::swap(corners[0], corners[1]);
  GridCheckOptions options;
  const GridCheck check = checkGrid(grid, options);
  EXPECT_EQ(std::ranges::count(check.defects, DefectKind::NotCounterClockwise, &GridDefect::kind),
            static_cast<std::ptrdiff_t>(grid.triangles.size()));
}

// Its boundary lies within a small cap, the mesh around it.
TEST(ClosedGrid, SoAreOceansAroundOneIsland) {
  const testing::SpaceVector island = testing::vectorOf({-71.0, 18.0});
  const Grid grid = testing::octahedralGlobe(5, [&](const testing::SpaceVector& middle) {
    return testing::dot(middle, island) < 0.995 * testing::lengthOf(middle);
  });
  const MeshInfo info = describeMesh(grid), whole = describeMesh(wholeGlobe(0.0));
  EXPECT_EQ(info.surface, "ellipsoid");
  EXPECT_GT(info.quality.min_angle_deg, whole.quality.min_angle_deg - 1.0);
  EXPECT_GT(info.area_m2, 0.99 * 5.10065621724e14);
  EXPECT_TRUE(checkBound(grid, info.quality.min_angle_deg).defects.empty());
}

}  // namespace
}  // namespace coastmesh
