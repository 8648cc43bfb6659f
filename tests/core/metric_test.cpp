#include "core/metric.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace coastmesh {
namespace {

constexpr double kNoLargest = 180.0;
constexpr double kAnySize = std::numeric_limits<double>::infinity();

// Triangles of all shapes, sizes and windings.
class RandomTriangles : public testing::Test {
 protected:
  double number(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  std::array<Point, 3> triangle() {
    const double size = std::exp(number(-5.0, 5.0)), flat = std::exp(number(-4.0, 0.0));
    const Point a{number(-9.0, 9.0), number(-9.0, 9.0)};
    const double turn = number(0.0, 7.0);
    const auto place = [&](double x, double y) {
      return Point{a.x + size * (x * std::cos(turn) - y * std::sin(turn)),
                   a.y + size * (x * std::sin(turn) + y * std::cos(turn))};
    };
    std::array<Point, 3> corners = {a, place(1.0, 0.0), place(number(-1.0, 2.0), flat)};
    std::shuffle(corners.begin(), corners.end(), random_);
    return corners;
  }
  // From the directions of the sides, unlike the code under test.
  static double angle(const Point& at, const Point& p, const Point& q) {
    const double turn = std::abs(std::atan2(q.y - at.y, q.x - at.x) - std::atan2(p.y - at.y, p.x - at.x));
    return std::min(turn, 2.0 * std::numbers::pi - turn);
  }
  static std::array<double, 3> angles(const std::array<Point, 3>& t) {
    return {angle(t[0], t[1], t[2]), angle(t[1], t[2], t[0]), angle(t[2], t[0], t[1])};
  }
  static std::array<double, 3> lengths(const std::array<Point, 3>& t) {
    const auto length = [](const Point& p, const Point& q) { return std::hypot(p.x - q.x, p.y - q.y); };
    return {length(t[1], t[2]), length(t[2], t[0]), length(t[0], t[1])};
  }

  std::mt19937 random_{11};
};

class LengthTwiceX final : public SizeFunction {
 public:
  double at(const Point& x) const override { return 2.0 * x.x; }
  double least() const override { return 2.0; }
  double most() const override { return 40.0; }
};

TEST(Points, Arithmetic) {
  const Point a{1, 2}, b{5, -3};
  EXPECT_EQ(a + b, (Point{6, -1}));
  EXPECT_EQ(b - a, (Point{4, -5}));
  EXPECT_EQ(2.0 * b, (Point{10, -6}));
  EXPECT_EQ(dot(a, b), -1.0);
  EXPECT_EQ(cross(a, b), -13.0);
  EXPECT_EQ(squaredLength(b), 34.0);
  EXPECT_EQ(squaredDistance(a, b), 41.0);
  EXPECT_EQ(distance({1, 2}, {4, 6}), 5.0);
  EXPECT_EQ(midpoint(a, b), (Point{3, -0.5}));
  EXPECT_EQ(midpoint({8, 2}, {16, 32}), (Point{12, 17}));
  EXPECT_NEAR(centroid({0, 0}, {3, 1}, {6, 5}).x, 3.0, 1e-15);
  EXPECT_NEAR(centroid({0, 0}, {3, 1}, {6, 5}).y, 2.0, 1e-15);
  EXPECT_EQ(projectedOnLine({3, 7}, {1, 1}, {9, 1}), (Point{3, 1}));
  EXPECT_EQ(projectedOnLine({-4, 7}, {1, 1}, {1, 5}), (Point{1, 7}));
}

TEST(Degrees, ToRadiansAndBack) {
  EXPECT_EQ(toRadians(180.0), std::numbers::pi);
  EXPECT_DOUBLE_EQ(toRadians(30.0), std::numbers::pi / 6.0);
  EXPECT_EQ(toDegrees(std::numbers::pi), 180.0);
  EXPECT_DOUBLE_EQ(toDegrees(std::numbers::pi / 6.0), 30.0);
}

TEST_F(RandomTriangles, AnglesAreThoseBetweenDirections) {
  for (int i = 0; i < 300; ++i) {
    const auto t = triangle();
    EXPECT_NEAR(angleAt(t[0], t[1], t[2]), angle(t[0], t[1], t[2]), 1e-12);
    EXPECT_NEAR(angleAt(t[0], t[2], t[1]), angle(t[0], t[1], t[2]), 1e-12);
  }
}

TEST_F(RandomTriangles, CircumcentresAreAsFarFromEachCorner) {
  for (int i = 0; i < 300; ++i) {
    const auto t = triangle();
    const Point offset = circumcenterOffset(t[0], t[1], t[2]);
    const Point centre{t[0].x + offset.x, t[0].y + offset.y};
    const double radius = std::hypot(offset.x, offset.y);
    for (const Point& corner : t)
      EXPECT_NEAR(std::hypot(centre.x - corner.x, centre.y - corner.y), radius, 1e-8 * radius);
  }
}

TEST_F(RandomTriangles, ShapesKnowTheirEdges) {
  for (int i = 0; i < 300; ++i) {
    const auto t = triangle();
    const TriangleShape shape(t[0], t[1], t[2]);
    const auto length = lengths(t);
    const auto angle = angles(t);
    EXPECT_EQ(shape.shortest, std::min_element(length.begin(), length.end()) - length.begin());
    EXPECT_EQ(shape.longest, std::max_element(length.begin(), length.end()) - length.begin());
    for (unsigned k = 0; k < 3; ++k) {
      EXPECT_NEAR(std::sqrt(shape.squared[k]), length[k], 1e-9 * length[k]);
      EXPECT_NEAR(shape.cosAt(k), std::cos(angle[k]), 1e-6);
    }
  }
}

TEST(TriangleShape, OfEqualEdgesTheFirst) {
  const TriangleShape two({0, 0}, {4, 0}, {2, 1});  // squared 5, 5, 16
  EXPECT_EQ(two.shortest, 0u);
  EXPECT_EQ(two.longest, 2u);
  const TriangleShape others({2, 1}, {0, 0}, {4, 0});  // 16, 5, 5
  EXPECT_EQ(others.shortest, 1u);
  EXPECT_EQ(others.longest, 0u);
  const TriangleShape ends({4, 0}, {2, 1}, {0, 0});  // 5, 16, 5
  EXPECT_EQ(ends.shortest, 0u);
  EXPECT_EQ(ends.longest, 1u);
  const TriangleShape tall({0, 0}, {2, 0}, {1, 5});  // 26, 26, 4
  EXPECT_EQ(tall.longest, 0u);
  EXPECT_EQ(tall.shortest, 2u);
  const TriangleShape lying({1, 5}, {0, 0}, {2, 0});  // 4, 26, 26
  EXPECT_EQ(lying.longest, 1u);
  EXPECT_EQ(lying.shortest, 0u);
  const TriangleShape standing({0, 0}, {1, 5}, {2, 0});  // 26, 4, 26
  EXPECT_EQ(standing.longest, 0u);
  EXPECT_EQ(standing.shortest, 1u);
  const TriangleShape none({1, 1}, {1, 1}, {1, 1});
  EXPECT_EQ(none.shortest, 0u);
  EXPECT_EQ(none.longest, 0u);
}

TEST(AngleBounds, HoldWhatIsAsked) {
  const double margin = 1e-6 * std::numbers::pi / 180.0;
  const AngleBound bound(30.0, 100.0);
  EXPECT_NEAR(bound.min_angle, std::numbers::pi / 6.0 + margin, 1e-15);
  EXPECT_NEAR(bound.max_angle, std::numbers::pi / 1.8 - margin, 1e-15);
  EXPECT_NEAR(bound.cos_min, std::cos(std::numbers::pi / 6.0), 1e-7);
  EXPECT_NEAR(bound.sin_min, 0.5, 1e-7);
  EXPECT_NEAR(bound.cot_min, std::sqrt(3.0), 1e-7);
  EXPECT_NEAR(bound.cos_max, std::cos(std::numbers::pi / 1.8), 1e-7);
  const AngleBound nothing(0.0, kNoLargest);
  EXPECT_EQ(nothing.min_angle, 0.0);
  EXPECT_EQ(nothing.max_angle, std::numbers::pi);
  EXPECT_EQ(AngleBound(0.5, 179.5).min_angle, std::numbers::pi / 360.0 + margin);
  EXPECT_LT(AngleBound(0.5, 179.5).max_angle, std::numbers::pi * 0.998);
}

TEST(TriangleBounds, TakeTheLesserOfBothLengths) {
  const LengthTwiceX wanted;
  EXPECT_EQ(TriangleBound(0.0, kNoLargest, 3.0).squared_size, 9.0);
  EXPECT_EQ(TriangleBound(0.0, kNoLargest, 3.0).size, nullptr);
  const TriangleBound both(0.0, kNoLargest, 30.0, &wanted, 0.5);  // at most 0.5 * 40
  EXPECT_EQ(both.squared_size, 400.0);
  EXPECT_EQ(both.size, &wanted);
  EXPECT_EQ(both.longest_share, 0.5);
  EXPECT_EQ(TriangleBound(0.0, kNoLargest, 15.0, &wanted, 0.5).squared_size, 225.0);
  EXPECT_EQ(TriangleBound(0.0, kNoLargest, 15.0, nullptr, 0.5).squared_size, 225.0);
}

TEST_F(RandomTriangles, AnglesAreBoundedFromBelowAndAbove) {
  for (int i = 0; i < 1000; ++i) {
    const auto t = triangle();
    const auto angle = angles(t);
    const double least = *std::min_element(angle.begin(), angle.end());
    const double most = *std::max_element(angle.begin(), angle.end());
    for (const double share : {0.999, 1.001}) {
      EXPECT_EQ(isSmallestAngleBelow(t[0], t[1], t[2], 1.0 / std::tan(share * least)), share > 1.0);
      EXPECT_EQ(isLargestAngleAbove(t[0], t[1], t[2], std::cos(share * most)), share < 1.0);
      if (share * least < std::numbers::pi / 3.0) {
        const TriangleBound smallest(toDegrees(share * least), kNoLargest, kAnySize);
        EXPECT_EQ(isBad(t[0], t[1], t[2], smallest), share > 1.0);
      }
      if (share * most < 0.99 * std::numbers::pi) {
        const TriangleBound largest(0.0, toDegrees(share * most), kAnySize);
        EXPECT_EQ(isBad(t[0], t[1], t[2], largest), share < 1.0);
      }
    }
    EXPECT_FALSE(isBad(t[0], t[1], t[2], TriangleBound(0.0, kNoLargest, kAnySize)));
  }
}

// Exact values: a right angle, one of 45 degrees and an edge that lie exactly on the bound satisfy it.
TEST(TriangleBounds, WhatIsOnTheBoundHoldsIt) {
  EXPECT_FALSE(isSmallestAngleBelow({0, 0}, {2, 0}, {0, 2}, 1.0));
  EXPECT_TRUE(isSmallestAngleBelow({0, 0}, {2, 0}, {0, 2}, std::nextafter(1.0, 0.0)));
  const std::array<Point, 3> right = {{{0, 0}, {3, 0}, {0, 4}}};
  for (unsigned i = 0; i < 3; ++i) {
    EXPECT_FALSE(isLargestAngleAbove(right[i], right[(i + 1) % 3], right[(i + 2) % 3], 0.0));
    EXPECT_TRUE(isLargestAngleAbove(right[i], right[(i + 1) % 3], right[(i + 2) % 3], 1e-12));
  }
  const TriangleBound five(0.0, kNoLargest, 5.0), less(0.0, kNoLargest, std::nextafter(5.0, 0.0));
  EXPECT_FALSE(isBad({0, 0}, {3, 0}, {0, 4}, five));
  EXPECT_TRUE(isBad({0, 0}, {3, 0}, {0, 4}, less));
}

// Without bounds, a flat triangle is good, however the product of its sides is rounded.
TEST_F(RandomTriangles, WhereNothingIsAskedAFlatOneIsGood) {
  const TriangleBound nothing(0.0, kNoLargest, kAnySize);
  for (int i = 0; i < 1000; ++i) {
    const Point step{std::round(number(1.0, 1e6)), std::round(number(1.0, 1e6))};
    EXPECT_FALSE(isBad({}, step, std::round(number(2.0, 1e6)) * step, nothing));
  }
}

TEST_F(RandomTriangles, EdgesAreBounded) {
  for (int i = 0; i < 300; ++i) {
    const auto t = triangle();
    const auto length = lengths(t);
    const double longest = *std::max_element(length.begin(), length.end());
    EXPECT_FALSE(isBad(t[0], t[1], t[2], TriangleBound(0.0, kNoLargest, 1.0001 * longest)));
    EXPECT_TRUE(isBad(t[0], t[1], t[2], TriangleBound(0.0, kNoLargest, 0.9999 * longest)));
    EXPECT_FALSE(isTooLong(t[0], t[1], t[2], longest * longest, TriangleBound(0.0, kNoLargest, 1.0001 * longest)));
    EXPECT_TRUE(isTooLong(t[0], t[1], t[2], longest * longest, TriangleBound(0.0, kNoLargest, 0.9999 * longest)));
  }
}

// The size at the centroid (2, 1) is 4, times a share of 0.5: 2.
TEST(TriangleBounds, LengthsAreWantedAtTheCentroid) {
  const LengthTwiceX wanted;
  const TriangleBound bound(0.0, kNoLargest, kAnySize, &wanted, 0.5);
  const Point a{1, 0}, b{3, 0}, c{2, 3};
  EXPECT_FALSE(isLongerThanWanted(a, b, c, 4.0 - 1e-12, bound));
  EXPECT_TRUE(isLongerThanWanted(a, b, c, 4.0 + 1e-12, bound));
  EXPECT_FALSE(isTooLong(a, b, c, 4.0 - 1e-12, bound));
  EXPECT_TRUE(isTooLong(a, b, c, 4.0 + 1e-12, bound));
  EXPECT_TRUE(isBad(a, b, c, bound));
  EXPECT_FALSE(isBad({1.9, 0}, {2.1, 0}, {2, 0.1}, bound));
}

TEST_F(RandomTriangles, AreasAreHalfOfBaseTimesHeight) {
  for (int i = 0; i < 300; ++i) {
    const auto t = triangle();
    const auto length = lengths(t);
    const double half = 0.5 * length[2] * length[1] * std::sin(angle(t[0], t[1], t[2]));
    EXPECT_NEAR(std::abs(areaOn({}, t[0], t[1], t[2])), half, 1e-9 * half);
    EXPECT_EQ(areaOn({}, t[0], t[1], t[2]) > 0.0, areaOn({}, t[0], t[2], t[1]) < 0.0);
    // On a sphere so large that it is flat here, in both windings.
    const Surface flat = Surface::sphere(1e9);
    EXPECT_NEAR(areaOn(flat, t[0], t[1], t[2]), half, 1e-5 * half);
    EXPECT_NEAR(areaOn(flat, t[0], t[2], t[1]), half, 1e-5 * half);
  }
  EXPECT_GT(areaOn({}, {0, 0}, {1, 0}, {0, 1}), 0.0);
}

// Angles must clear the bound by the margin times the longest edge; the bound is never relaxed.
TEST(IsBadOnASphere, TheMarginMakesBoundsStricter) {
  const double slack = 0.01;
  const Point a{0, 0}, b{10, 0}, c{5, 9};  // 10.3 long; 58.1, 60.9 and 60.9 degrees
  const double longest = std::hypot(5.0, 9.0), least = 2.0 * std::atan(5.0 / 9.0), most = std::atan(9.0 / 5.0);
  for (const double beyond : {-1.5, -0.5, 0.5, 1.5}) {
    TriangleBound smallest(toDegrees(least + beyond * slack), kNoLargest, kAnySize);
    TriangleBound largest(0.0, toDegrees(most + beyond * slack), kAnySize);
    for (TriangleBound* bound : {&smallest, &largest}) bound->surface = Surface::sphere(1e7, slack / longest);
    EXPECT_EQ(isBad(a, b, c, smallest), beyond > -1.0) << beyond;
    EXPECT_EQ(isBad(a, b, c, largest), beyond < 1.0) << beyond;
  }
}

TEST(DistanceToSegment, OnASphere) {
  const Surface sphere = Surface::sphere(1000.0);
  EXPECT_EQ(distanceToSegment({}, {3, 4}, {0, 0}, {0, 0}), 5.0);
  EXPECT_EQ(distanceToSegment({}, {2, 7}, {0, 4}, {9, 4}), 3.0);
  // Near the projection centre lengths equal those in the plane; farther out they shrink.
  EXPECT_NEAR(distanceToSegment(sphere, {2, 7}, {0, 4}, {9, 4}), 3.0, 1e-3);
  const double shrink = 1.0 / (1.0 + 0.25);
  EXPECT_NEAR(distanceToSegment(sphere, {1000, 3}, {999, 0}, {1001, 0}), 3.0 * shrink, 1e-2);
}

TEST(DistanceToSegment, IsThatToTheNearestPoint) {
  const Point a{1, 1}, b{5, 4};  // 5 long
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({-2, -3}, a, b), 25.0);
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({8, 8}, a, b), 25.0);
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({0, 6}, a, b), 23.0 * 23.0 / 25.0);
  EXPECT_DOUBLE_EQ(squaredDistanceToSegment({6, -1}, a, b), 23.0 * 23.0 / 25.0);
  EXPECT_EQ(squaredDistanceToSegment({3, 4}, {0, 0}, {0, 0}), 25.0);
}

// The distance is as small as the grain of the coordinates, to which the foot of a perpendicular would be rounded.
TEST(DistanceToSegment, KeepsItsDigitsFarFromTheOrigin) {
  const double grain = 0x1p-10, far = 0x1p42;  // coordinates near `far` are multiples of the grain
  const Point a{far, far}, p{far + grain, far}, b{far + 4096 * grain, far + 8192 * grain};
  const double expected = grain * 2 / std::sqrt(5.0);
  EXPECT_NEAR(std::sqrt(squaredDistanceToSegment(p, a, b)), expected, 1e-12 * expected);
  EXPECT_NEAR(std::sqrt(squaredDistanceToSegment(p, b, a)), expected, 1e-12 * expected);
}

TEST_F(RandomTriangles, NearestPointOfASegmentIsAtItsDistance) {
  std::size_t inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto [a, b, p] = triangle();
    const Point nearest = nearestOnSegment(p, a, b);
    const double share = shareAlongSegment(p, a, b), length = distance(a, b);
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    EXPECT_NEAR(distance(a, nearest), share * length, 1e-12 * (length + 10.0));
    EXPECT_NEAR(distance(p, nearest), std::sqrt(squaredDistanceToSegment(p, a, b)), 1e-9 * (length + 1.0));
    if (share > 0.0 && share < 1.0) ++inside;
  }
  EXPECT_GT(inside, 200u);
  EXPECT_LT(inside, 1800u);
  EXPECT_EQ(nearestOnSegment({3.0, 4.0}, {1.0, 2.0}, {1.0, 2.0}), (Point{1.0, 2.0}));
}

}  // namespace
}  // namespace coastmesh
