#include "gis/shore/shore_frame.hpp"

#include <gtest/gtest.h>

namespace coastmesh {
namespace {

using Sides = std::vector<std::pair<Point, Point>>;

TEST(ShoreFrame, ASideOfTwoPartsIsNoLimit) {
  const ShoreFrame two(
      {{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}, {{1, 1}, {0, 0}}, {{1, 0}, {2, 1}}, {{2, 1}, {1, 1}}, {{1, 1}, {1, 0}}});
  EXPECT_FALSE(two.parts({0.9, 0.5}, {1.1, 0.5}));
  EXPECT_TRUE(two.parts({0.9, 0.5}, {0.9, -0.5}));
  EXPECT_TRUE(two.parts({0.9, 0.5}, {2.9, 0.5}));
  EXPECT_TRUE(two.parts({0.95, 0.5}, {1.05, -0.5}));
}

TEST(ShoreFrame, AWayThroughACornerCrossesOnce) {
  const ShoreFrame corner(Sides{{{0, 0}, {1, 1}}, {{1, 1}, {2, 0}}});
  EXPECT_TRUE(corner.parts({1, 0}, {1, 2}));
  EXPECT_FALSE(corner.parts({0, 1}, {2, 1}));
}

}  // namespace
}  // namespace coastmesh
