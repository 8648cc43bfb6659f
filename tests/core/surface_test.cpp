#include "core/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/metric.hpp"
#include "core/space_point.hpp"

namespace coastmesh {
namespace {

constexpr double kRadius = 6371.0;
const Surface kSphere = Surface::sphere(kRadius);

// Stereographic projection, implemented independently: the point of the sphere that x shows, projected from the south
// pole.
SpacePoint inSpace(const Point& x) {
  const double q = (x.x * x.x + x.y * x.y) / (4.0 * kRadius * kRadius);
  return {x.x / (1.0 + q), x.y / (1.0 + q), kRadius * (1.0 - q) / (1.0 + q)};
}

double angleInSpace(const SpacePoint& at, const SpacePoint& p, const SpacePoint& q) {
  return std::atan2(lengthOf(cross(p - at, q - at)), dot(p - at, q - at));
}

std::array<double, 3> anglesInSpace(const Point& a, const Point& b, const Point& c) {
  const SpacePoint u = inSpace(a), v = inSpace(b), w = inSpace(c);
  return {angleInSpace(u, v, w), angleInSpace(v, w, u), angleInSpace(w, u, v)};
}

class OnTheSphere : public testing::Test {
 protected:
  // From near the centre to far beyond the hemisphere.
  Point somewhere() {
    const double far = kRadius * std::exp(std::uniform_real_distribution(-3.0, 4.0)(random_));
    const double angle = std::uniform_real_distribution(0.0, 2.0 * std::numbers::pi)(random_);
    return {far * std::cos(angle), far * std::sin(angle)};
  }
  Point near(const Point& x, double length) {
    const double angle = std::uniform_real_distribution(0.0, 2.0 * std::numbers::pi)(random_);
    const double share = std::uniform_real_distribution(0.1, 1.0)(random_);
    return Frame(kSphere, x).from({share * length * std::cos(angle), share * length * std::sin(angle)});
  }

  std::mt19937 random_{7};
};

TEST_F(OnTheSphere, ChordsAreThoseInSpace) {
  for (int i = 0; i < 1000; ++i) {
    const Point a = somewhere(), b = somewhere();
    EXPECT_NEAR(kSphere.chord(a, b), distance(inSpace(a), inSpace(b)), 1e-9 * kRadius);
  }
}

TEST_F(OnTheSphere, FramesTurnTheSphere) {
  for (int i = 0; i < 1000; ++i) {
    const Point centre = somewhere(), a = somewhere(), b = somewhere();
    const Frame frame(kSphere, centre);
    const Point in_frame = frame.to(centre);
    EXPECT_NEAR(in_frame.x, 0.0, 1e-9);
    EXPECT_NEAR(in_frame.y, 0.0, 1e-9);
    EXPECT_NEAR(kSphere.chord(frame.to(a), frame.to(b)), kSphere.chord(a, b), 1e-8 * kRadius);
    const Point back = frame.from(frame.to(a));
    EXPECT_NEAR(kSphere.chord(back, a), 0.0, 1e-8 * kRadius);
  }
}

TEST_F(OnTheSphere, AFrameOfThePlaneChangesNothing) {
  const Frame frame({}, {3.0, 4.0});
  EXPECT_EQ(frame.to({0.1, 0.7}), (Point{0.1, 0.7}));
  EXPECT_EQ(frame.from({0.1, 0.7}), (Point{0.1, 0.7}));
  EXPECT_EQ(frame.relative({0.5, 0.25}), (Point{-2.5, -3.75}));
  EXPECT_EQ(frame.absolute({-2.5, -3.75}), (Point{0.5, 0.25}));
}

TEST_F(OnTheSphere, BadIsWhatTheFlatTriangleInSpaceIs) {
  TriangleBound bound(33.0, 100.0, 900.0);
  bound.surface = kSphere;
  int bad = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point a = somewhere();
    Point b = near(a, 1200.0), c = near(a, 1200.0);
    // Counter-clockwise as seen from outside, like triangles of a mesh.
    if (const Frame at_a(kSphere, a); cross(at_a.relative(b), at_a.relative(c)) < 0.0) std::swap(b, c);
    const auto angles = anglesInSpace(a, b, c);
    const double least = std::ranges::min(angles), most = std::ranges::max(angles);
    const double longest = std::max(
        {distance(inSpace(a), inSpace(b)), distance(inSpace(b), inSpace(c)), distance(inSpace(c), inSpace(a))});
    if (std::min({std::abs(least - toRadians(33.0)), std::abs(most - toRadians(100.0)),
                  std::abs(longest / 900.0 - 1.0)}) < 1e-6)
      continue;
    const bool expected = least < toRadians(33.0) || most > toRadians(100.0) || longest > 900.0;
    EXPECT_EQ(isBad(a, b, c, bound), expected);
    bad += expected;
  }
  EXPECT_GT(bad, 1000);
  EXPECT_LT(bad, 19000);
}

TEST_F(OnTheSphere, AMarginMakesTheBoundStricterByTheLongestEdge) {
  const Point a{0.0, 0.0}, b{400.0, 0.0}, c{200.0, 200.0 * std::tan(toRadians(33.05))};
  TriangleBound bound(33.0, 180.0, std::numeric_limits<double>::infinity());
  bound.surface = kSphere;
  EXPECT_FALSE(isBad(a, b, c, bound));
  bound.surface.margin = toRadians(0.1) / 400.0;
  EXPECT_TRUE(isBad(a, b, c, bound));
}

TEST_F(OnTheSphere, AreasAreThoseOfFlatTriangles) {
  for (int i = 0; i < 1000; ++i) {
    const Point a = somewhere(), b = near(a, 2000.0), c = near(a, 2000.0);
    const SpacePoint u = inSpace(a), v = inSpace(b), w = inSpace(c);
    EXPECT_NEAR(areaOn(kSphere, a, b, c), 0.5 * lengthOf(cross(v - u, w - u)), 1e-6 * 2000.0 * 2000.0);
  }
}

}  // namespace
}  // namespace coastmesh
