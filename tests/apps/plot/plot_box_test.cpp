#include "apps/plot/plot_box.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

using Triangles = std::vector<std::uint32_t>;

// Three triangles side by side, each a degree wide, from this longitude on: west of 180, across it, east of it.
Grid gridFrom(const Crs& crs, std::vector<double> longitudes) {
  Grid grid;
  grid.crs = crs;
  for (const double x : longitudes) {
    grid.nodes.push_back({x, 65.0});
    grid.nodes.push_back({x, 66.0});
  }
  grid.triangles = {{0, 2, 1}, {2, 4, 3}, {4, 6, 5}};
  return grid;
}

class PlotBoxAt180 : public ::testing::TestWithParam<std::vector<double>> {};

TEST_P(PlotBoxAt180, HoldsTrianglesAfterAnyNumberOfTurns) {
  const Grid grid = gridFrom(wgs84(), GetParam());
  for (const double turn : {-360.0, 0.0, 360.0}) {
    EXPECT_EQ(trianglesIn(grid, PlotBox{178.6 + turn, 65.2, 181.4 + turn, 65.4}), (Triangles{0, 1, 2})) << turn;
    EXPECT_EQ(trianglesIn(grid, PlotBox{178.6 + turn, 65.2, 179.0 + turn, 65.4}), (Triangles{0})) << turn;
    EXPECT_EQ(trianglesIn(grid, PlotBox{180.8 + turn, 65.2, 181.2 + turn, 65.4}), (Triangles{2})) << turn;
  }
}

// A triangle across 180 is not at every longitude.
TEST_P(PlotBoxAt180, HoldsNoTriangleFromElsewhere) {
  const Grid grid = gridFrom(wgs84(), GetParam());
  EXPECT_EQ(trianglesIn(grid, PlotBox{-10.0, 65.2, 10.0, 65.4}), Triangles{});
  EXPECT_EQ(trianglesIn(grid, PlotBox{178.6, 60.0, 181.4, 61.0}), Triangles{});
}

TEST_P(PlotBoxAt180, OfAllLongitudesHoldsAll) {
  const Grid grid = gridFrom(wgs84(), GetParam());
  EXPECT_EQ(trianglesIn(grid, PlotBox{-180.0, 60.0, 180.0, 70.0}), (Triangles{0, 1, 2}));
  EXPECT_EQ(trianglesIn(grid, {}), (Triangles{0, 1, 2}));
}

INSTANTIATE_TEST_SUITE_P(Longitudes, PlotBoxAt180,
                         ::testing::Values(std::vector{178.5, 179.5, -179.5, -178.5},
                                           std::vector{178.5, 179.5, 180.5, 181.5},
                                           std::vector{-181.5, -180.5, -179.5, -178.5}));

TEST(PlotBox, InAPlaneHasNoTurns) {
  const Grid grid = gridFrom(Crs{}, {178.5, 179.5, 180.5, 181.5});
  EXPECT_EQ(trianglesIn(grid, PlotBox{178.6, 65.2, 181.4, 65.4}), (Triangles{0, 1, 2}));
  EXPECT_EQ(trianglesIn(grid, PlotBox{-181.4, 65.2, -178.6, 65.4}), Triangles{});
}

}  // namespace
}  // namespace coastmesh
