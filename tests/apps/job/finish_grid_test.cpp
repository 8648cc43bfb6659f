#include "apps/job/finish_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/quality.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/gis/repair/slanting_sea.hpp"
#include "tests/support/rasters.hpp"

namespace coastmesh {
namespace {

// Two separate squares of water; the first has an open boundary.
Grid twoWaters() {
  Grid grid;
  for (const double west : {0.0, 20.0}) {
    const auto first = static_cast<std::uint32_t>(grid.nodes.size());
    for (const Point& p : {Point{west, 0}, Point{west + 10, 0}, Point{west + 10, 10}, Point{west, 10}})
      grid.nodes.push_back(p);
    for (const auto& corners : {std::array{first, first + 1, first + 2}, std::array{first, first + 2, first + 3}}) {
      grid.triangles.push_back(corners);
      grid.area_m2.push_back(50.0);
    }
    grid.boundaries.push_back(
        {first == 0 ? BoundaryRole::Open : BoundaryRole::Land, true, {first, first + 1, first + 2, first + 3}});
  }
  return grid;
}

// The second square is deeper, and partly above the water.
TEST(FinishGrid, DepthsAreThoseOfTheWaterThatIsLeft) {
  const testing::TemporaryFolder folder;
  const std::string path = folder / "bed.tif";
  testing::writeRaster(path, "", {60, 40, -10.0, 25.0, 1.0}, [](double x, double y) {
    return x < 15.0 ? -20.0 : y > 5.0 ? 3.0 : -400.0;
  });
  FinishOptions options;
  options.depth.files = {path};
  for (const bool drops : {false, true}) {
    Grid grid = twoWaters();
    options.drop_apart = drops;
    const FinishReport report = finishGrid(grid, options);
    EXPECT_EQ(report.dropped.waters, drops ? 1u : 0u);
    EXPECT_EQ(report.depth.nodes_of_file.at(0), grid.nodes.size());
    EXPECT_NEAR(report.depth.greatest_m, drops ? 20.0 : 400.0, 1e-6);
    EXPECT_EQ(report.depth.above_water, drops ? 0u : 2u);
  }
}

// The second square is left out, and with it one of the requested nodes; (5, 5) never was a node.
TEST(FinishGrid, RequestedNodesThatAreLeftOutAreNamed) {
  FinishOptions options;
  options.drop_apart = true;
  options.repair.asked = {{30.0, 10.0}, {5.0, 5.0}, {10.0, 0.0}, {30.0, 10.0}};
  Grid grid = twoWaters();
  const FinishReport report = finishGrid(grid, options);
  EXPECT_EQ(report.lost_asked, (std::vector<Point>{{30.0, 10.0}}));
  const std::vector<std::string> warnings = report.warnings();
  EXPECT_EQ(
      std::ranges::count_if(
          warnings, [](const std::string& text) { return text.starts_with("1 point of --constraints is no node"); }),
      1);
}

// A corner of 40 degrees that FVCOM needs two triangles in: a mesh from elsewhere has no bound, but regular triangles.
TEST(FinishGrid, RepairsOfMeshesFromElsewhereMakeNoSharpTriangles) {
  constexpr std::uint32_t kSouth = 6;  // nodes in the south, the first ones
  Grid grid = testing::slantingSea(kSouth - 1, 40.0, [](std::uint32_t from, std::uint32_t to) {
    return BoundaryKind{from < kSouth && to < kSouth ? BoundaryRole::Open : BoundaryRole::Land};
  });
  FinishOptions options;
  options.targets = {"fvcom"};
  const FinishReport report = finishGrid(grid, options);
  EXPECT_FALSE(report.repairs.repairs.empty());
  EXPECT_TRUE(report.repairs.left.empty());
  for (const auto& [a, b, c] : grid.triangles)
    EXPECT_GE(leastAngleDeg(grid.nodes[a], grid.nodes[b], grid.nodes[c]), 25.0 - 0.02);
}

// The second water is a single triangle.
TEST(FinishGrid, MuchWaterThatRepairsTakeOutIsWarnedOf) {
  FinishOptions options;
  options.targets = {"schism"};
  for (const bool large : {false, true}) {
    Grid grid = twoWaters();
    grid.triangles.pop_back();
    grid.nodes.pop_back();
    grid.nodes.back() = {30.0, large ? 10.0 : 0.1};
    grid.area_m2 = {50.0, 50.0, large ? 50.0 : 0.5};
    grid.boundaries.back().nodes.pop_back();
    const FinishReport report = finishGrid(grid, options);
    EXPECT_EQ(grid.triangles.size(), 2u);
    EXPECT_NEAR(report.lost.area_m2, large ? 50.0 : 0.5, 1e-12);
    EXPECT_NEAR(report.lost.share, large ? 1.0 / 3.0 : 0.5 / 100.5, 1e-12);
    const std::vector<std::string> warnings = report.warnings();
    EXPECT_EQ(
        std::ranges::count_if(warnings,
                              [](const std::string& text) {
                                return text.starts_with("repairs took out 50 (33 %) of the water, with 1 triangle");
                              }),
        large ? 1 : 0);
  }
}

}  // namespace
}  // namespace coastmesh
