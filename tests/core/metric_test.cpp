#include "core/metric.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coastmesh {
namespace {

TEST(DistanceToSegment, IsThatToTheNearestPoint) {
  const Point a{1, 1}, b{5, 4};  // 5 long
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({-2, -3}, a, b), 25.0);
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({8, 8}, a, b), 25.0);
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({0, 6}, a, b), 23.0 * 23.0 / 25.0);
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({6, -1}, a, b), 23.0 * 23.0 / 25.0);
  EXPECT_EQ(squaredDistanceToSegment({3, 4}, {0, 0}, {0, 0}), 25.0);
}

// A foot of the perpendicular would be rounded to the grain of coordinates, which the distance is as large as.
TEST(DistanceToSegment, KeepsItsDigitsFarFromTheOrigin) {
  const double grain = 0x1p-10, far = 0x1p42;  // coordinates near `far` are multiples of the grain
  const Point a{far, far}, p{far + grain, far}, b{far + 4096 * grain, far + 8192 * grain};
  const double expected = grain * 2 / std::sqrt(5.0);
  EXPECT_NEAR(std::sqrt(squaredDistanceToSegment(p, a, b)), expected, 1e-12 * expected);
  EXPECT_NEAR(std::sqrt(squaredDistanceToSegment(p, b, a)), expected, 1e-12 * expected);
}

}  // namespace
}  // namespace coastmesh
