#include "gis/geometry/crossing.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "core/predicates.hpp"

namespace coastmesh {
namespace {

using Rational = boost::multiprecision::cpp_rational;

bool crossProperly(const Point& a, const Point& b, const Point& c, const Point& d) {
  return orient2d(a, b, c) * orient2d(a, b, d) < 0 && orient2d(c, d, a) * orient2d(c, d, b) < 0;
}

struct ExactPoint {
  Rational x, y;
};

ExactPoint exactCrossing(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Rational ax(a.x), ay(a.y), cx(c.x), cy(c.y);
  const Rational ux = Rational(b.x) - ax, uy = Rational(b.y) - ay, vx = Rational(d.x) - cx, vy = Rational(d.y) - cy;
  const Rational share = ((cx - ax) * vy - (cy - ay) * vx) / (ux * vy - uy * vx);
  return {ax + share * ux, ay + share * uy};
}

// True if no other double is nearer.
bool isNearest(double value, const Rational& exact) {
  const auto off = [&](double v) -> Rational { return abs(Rational(v) - exact); };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return off(value) <= off(std::nextafter(value, kInfinity)) && off(value) <= off(std::nextafter(value, -kInfinity));
}

// Crossings of segments in a square of side `size` around `centre`; every other pair is nearly parallel.
void expectNearest(const Point& centre, double size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-0.5 * size, 0.5 * size), small(-1e-9 * size, 1e-9 * size);
  const auto any = [&] { return Point{centre.x + place(random), centre.y + place(random)}; };
  constexpr int kCrossings = 5000;
  int wrong = 0;
  for (int found = 0; found < kCrossings;) {
    const Point a = any(), b = any();
    const bool aslant = found % 2 == 1;
    const Point c = aslant ? Point{a.x + small(random), a.y + small(random)} : any();
    const Point d = aslant ? Point{b.x + small(random), b.y + small(random)} : any();
    if (!crossProperly(a, b, c, d)) continue;
    ++found;
    const Point place_of = crossingPoint(a, b, c, d);
    const ExactPoint exact = exactCrossing(a, b, c, d);
    wrong += !isNearest(place_of.x, exact.x) || !isNearest(place_of.y, exact.y);
  }
  EXPECT_EQ(wrong, 0) << "of " << kCrossings << ", seed " << seed;
}

TEST(Crossing, IsRoundedToTheNearestDouble) {
  expectNearest({0.0, 0.0}, 2.0, 1);
  expectNearest({-3.1e6, 5.7e6}, 1e4, 2);
  expectNearest({0.0, 0.0}, 1e70, 3);
  expectNearest({0.0, 0.0}, 1e-60, 4);
}

TEST(Crossing, OnALineAlongAnAxisLiesOnIt) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(1.0, 1e5);
  for (int k = 0; k < 1000; ++k) {
    const Point left{-place(random), -place(random)}, right{place(random), -place(random)};
    const Point found = crossingPoint(left, right, {0.0, -1e5}, {0.0, 1e5});
    EXPECT_EQ(found.x, 0.0);
    const Point turned = crossingPoint({-1e5, 0.0}, {1e5, 0.0}, {left.y, left.x}, {right.y, right.x});
    EXPECT_EQ(turned.y, 0.0);
    EXPECT_EQ(turned.x, found.y);
  }
}

// The smallest angle that doubles can have between two directions.
TEST(Crossing, LiesOnSegmentsThatAreAllButParallel) {
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  const Point a{1.0, 1.0}, b{2.0 - kUlp, 2.0 - 2 * kUlp}, c{1.0, 1.0 - 1e-15}, d{2.0 - kUlp, 2.0};
  ASSERT_TRUE(crossProperly(a, b, c, d));
  const Point found = crossingPoint(a, b, c, d);
  const ExactPoint exact = exactCrossing(a, b, c, d);
  EXPECT_TRUE(isNearest(found.x, exact.x)) << found.x;
  EXPECT_TRUE(isNearest(found.y, exact.y)) << found.y;
}

}  // namespace
}  // namespace coastmesh
