#include "core/size/on_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kRadius = 6371.0;
const Surface kSphere = Surface::sphere(kRadius);

// Midpoint rule over small rectangles.
double areaBySums(const Point& low, const Point& high) {
  constexpr int kSteps = 400;
  const Point step{(high.x - low.x) / kSteps, (high.y - low.y) / kSteps};
  double area = 0.0;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const double shrink = kSphere.shrinkAt({low.x + (i + 0.5) * step.x, low.y + (j + 0.5) * step.y});
      area += step.x * step.y * shrink * shrink;
    }
  }
  return area;
}

TEST(OnSurface, AreasOfRectangles) {
  EXPECT_EQ(areaOn({}, {1.0, 2.0}, {4.0, 4.0}), 6.0);
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    const double reach = kRadius * std::exp(uniform(random, std::log(1e-3), std::log(20.0)));
    const Point low{uniform(random, -30.0 * kRadius, 10.0 * kRadius), uniform(random, -30.0 * kRadius, 10.0 * kRadius)};
    const Point high = low + Point{reach * uniform(random, 0.1, 1.0), reach * uniform(random, 0.1, 1.0)};
    const double area = areaOn(kSphere, low, high);
    EXPECT_NEAR(area / areaBySums(low, high), 1.0, 2e-3) << low.x << " " << low.y << " " << reach;
  }
  // The whole sphere except what lies beyond `far`.
  const double all = 4.0 * std::numbers::pi * kRadius * kRadius, far = 1e5 * kRadius;
  EXPECT_NEAR(areaOn(kSphere, {-far, -far}, {far, far}) / all, 1.0, 1e-8);
  // Squares around the origin with sizes on both sides of the limit below which the shrink counts as constant.
  for (const double half : {1e-3, 1.0, 100.0, 280.0, 290.0, 1000.0})
    EXPECT_NEAR(areaOn(kSphere, SizeBox{{0.0, 0.0}, half}) / areaBySums({-half, -half}, {half, half}), 1.0, 1e-3)
        << half;
}

TEST(OnSurface, ArcsAndChords) {
  EXPECT_EQ(arcOfChord({}, 3.0), 3.0);
  EXPECT_EQ(chordOfArc({}, 3.0), 3.0);
  // From the origin to the edge of the hemisphere around it, and across the hemisphere.
  const double rim = 2.0 * kRadius;
  EXPECT_NEAR(arcBetween(kSphere, {0.0, 0.0}, {rim, 0.0}), 0.5 * std::numbers::pi * kRadius, 1e-9);
  EXPECT_NEAR(arcBetween(kSphere, {0.0, -rim}, {0.0, rim}), std::numbers::pi * kRadius, 1e-3);
  // One degree is the same arc inside and outside the hemisphere.
  const auto out = [](double degrees) { return Point{2.0 * kRadius * std::tan(0.5 * toRadians(degrees)), 0.0}; };
  for (const double degrees : {1.0, 30.0, 89.0, 150.0, 178.0}) {
    EXPECT_NEAR(arcBetween(kSphere, out(degrees), out(degrees + 1.0)), toRadians(1.0) * kRadius, 1e-6);
    const double arc = toRadians(degrees) * kRadius;
    EXPECT_NEAR(arcOfChord(kSphere, chordOfArc(kSphere, arc)), arc, 1e-6);
  }
  EXPECT_EQ(chordOfArc(kSphere, 10.0 * kRadius), 2.0 * kRadius) << "no arc is longer";
}

TEST(OnSurface, ShrinkInSquares) {
  const ShrinkRange plane = shrinkIn({}, {{5.0, 5.0}, 2.0});
  EXPECT_EQ(plane.low, 1.0);
  EXPECT_EQ(plane.high, 1.0);
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    const SizeBox box{{uniform(random, -5e4, 5e4), uniform(random, -5e4, 5e4)}, uniform(random, 0.0, 5e4)};
    const ShrinkRange range = shrinkIn(kSphere, box);
    for (int k = 0; k < 1000; ++k) {
      const Point off{uniform(random, -box.half, box.half), uniform(random, -box.half, box.half)};
      const double shrink = kSphere.shrinkAt(box.centre + off);
      EXPECT_LE(range.low, shrink);
      EXPECT_GE(range.high, shrink);
    }
  }
}

}  // namespace
}  // namespace coastmesh
