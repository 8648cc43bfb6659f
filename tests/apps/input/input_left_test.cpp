// What is left of the input in a grid that was finished.
#include <gtest/gtest.h>

#include "apps/job/judge_mesh.hpp"

namespace coastmesh {

namespace {

// Two groups of a square each: its corners, vertices of the input, and its middle.
class InputLeft : public ::testing::Test {
 protected:
  InputLeft() {
    for (std::uint32_t g = 0; g < 2; ++g) {
      const double west = 10.0 * g;
      grid_.nodes.insert(grid_.nodes.end(), {{west, 0}, {west + 2, 0}, {west + 2, 2}, {west, 2}, {west + 1, 1}});
      grid_.feature_of.insert(grid_.feature_of.end(), {2 * g, 2 * g, 2 * g + 1, 2 * g + 1});
      groups_.push_back({g, 0.0, 2 * g, 5 * g, 4, 4.2});
    }
  }
  Grid grid_;
  std::vector<MergedGroup> groups_;
};

TEST_F(InputLeft, NodesThatAreMovedOrAddedAreNotOfTheInput) {
  const InputVertices vertices(grid_, groups_);
  const auto others = [&] { return InputVertices(vertices).othersIn(grid_); };
  EXPECT_EQ(others(), 2u);
  grid_.nodes[0].x += 0.5;
  grid_.nodes.push_back({30, 30});
  EXPECT_EQ(others(), 4u);
  grid_.nodes.erase(grid_.nodes.begin() + 5, grid_.nodes.begin() + 10);
  EXPECT_EQ(others(), 3u);
}

TEST_F(InputLeft, AreasThatAreDroppedDoNotCount) {
  constexpr double kAll = 8.4;
  EXPECT_EQ(inputAreaLeft(kAll, grid_, groups_, {}), kAll);
  DroppedWaters dropped;
  dropped.area_of = {{2, 1.0}};
  EXPECT_NEAR(inputAreaLeft(kAll, grid_, groups_, dropped), 7.4, 1e-12);
  // Of a whole group, its input goes, although the mesh had less.
  dropped.area_of = {{2, 2.0}, {3, 2.0}};
  grid_.feature_of.resize(4);
  EXPECT_NEAR(inputAreaLeft(kAll, grid_, groups_, dropped), 4.2, 1e-12);
}

}  // namespace

}  // namespace coastmesh
