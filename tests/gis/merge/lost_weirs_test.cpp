#include "gis/merge/lost_weirs.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/gis/merge/merged.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;

// Opens a weir along the nodes on a height, between two places: those inside get another node above.
void openWeir(Grid& grid, double y, double from, double to) {
  Boundary wall{BoundaryRole::Land, false, {}, 24};
  for (std::uint32_t i = 0; i < grid.nodes.size(); ++i)
    if (std::abs(grid.nodes[i].y - y) < 1e-9 && grid.nodes[i].x >= from && grid.nodes[i].x <= to)
      wall.nodes.push_back(i);
  std::ranges::sort(wall.nodes, std::ranges::greater{}, [&](std::uint32_t i) { return grid.nodes[i].x; });
  wall.back_nodes = wall.nodes;
  for (std::size_t k = 1; k + 1 < wall.nodes.size(); ++k) {
    const std::uint32_t node = wall.nodes[k],
                        across = wall.back_nodes[k] = static_cast<std::uint32_t>(grid.nodes.size());
    grid.nodes.push_back(grid.nodes[node] + Point{0.0, 0.05});
    grid.z.push_back(grid.z[node]);
    for (GridCorners& v : grid.triangles)
      if (grid.nodes[v[0]].y + grid.nodes[v[1]].y + grid.nodes[v[2]].y > 3.0 * y) std::ranges::replace(v, node, across);
  }
  for (std::size_t k = 0; k < wall.nodes.size(); ++k) wall.weir.insert(wall.weir.end(), {2.0, 1.0, 1.0});
  grid.boundaries.push_back(wall);
  requireConsistent(grid);
}

Grid nestFrom(double x) { return gridOf({16, 16, 0.25, {x, 8.1}}, BoundaryRole::Open); }

TEST(LostWeirs, AFrameAcrossAWeirLeavesGapsThatAreNamed) {
  Grid grid = gridOf({20, 20, 1.0});
  openWeir(grid, 10.0, 2.0, 18.0);
  Grid nest = nestFrom(8.1);
  openWeir(nest, 10.1, 8.5, 11.7);
  const std::vector<WeirGap> gaps = mergeGrids(grid, std::move(nest)).weir_gaps;
  ASSERT_EQ(gaps.size(), 2u);
  // From the last pair that is left on either side, at a whole x, to the nest's own weir from 8.6 to 11.6.
  EXPECT_GE(gaps[0].length_m, gaps[1].length_m);
  for (const WeirGap& gap : gaps) {
    const bool is_west = gap.place.x < 10.0;
    EXPECT_NEAR(gap.place.y, 10.0, 0.03);
    EXPECT_LT(std::abs(gap.place.x - (is_west ? 8.1 : 12.1)), 2.0);
    EXPECT_NEAR(gap.length_m, is_west ? 8.6 - gap.place.x : gap.place.x - 11.6, 0.02);
  }
}

// A weir that ends between the frames is lost there altogether.
TEST(LostWeirs, AnEndThatIsLostIsAGap) {
  Grid grid = gridOf({20, 20, 1.0});
  openWeir(grid, 10.0, 2.0, 12.0);
  Grid nest = nestFrom(8.1);
  openWeir(nest, 10.1, 8.5, 9.7);
  const std::vector<WeirGap> gaps = mergeGrids(grid, std::move(nest)).weir_gaps;
  ASSERT_EQ(gaps.size(), 2u);
  // In the east from about 9.6 to 12, in whole edges.
  EXPECT_NEAR(gaps[0].length_m, 2.0, 0.02);
  EXPECT_NEAR(gaps[0].place.x, 11.0, 0.02);
  EXPECT_LT(gaps[1].place.x, 8.1);
}

TEST(LostWeirs, WithoutWeirsOfTheOtherMeshAllIsAGap) {
  Grid grid = gridOf({20, 20, 1.0});
  openWeir(grid, 10.0, 9.0, 11.0);
  const std::vector<WeirGap> gaps = mergeGrids(grid, nestFrom(8.1)).weir_gaps;
  ASSERT_EQ(gaps.size(), 1u);
  EXPECT_NEAR(gaps[0].length_m, 2.0, 0.01);
  EXPECT_NEAR(gaps[0].place.x, 10.0, 0.01);
}

TEST(LostWeirs, OfOthersThereIsNoMessage) {
  Grid grid = gridOf({20, 20, 1.0});
  openWeir(grid, 10.0, 9.0, 11.0);
  openWeir(grid, 3.0, 2.0, 18.0);
  Grid nest = nestFrom(8.1);
  openWeir(nest, 10.1, 8.5, 11.7);
  EXPECT_TRUE(mergeGrids(grid, std::move(nest)).weir_gaps.empty());
  EXPECT_EQ(weirsOf(grid).size(), 2u);
}

}  // namespace
}  // namespace coastmesh
