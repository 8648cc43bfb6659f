#include "core/predicates.hpp"

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

using Rational = boost::multiprecision::cpp_rational;

int exactOrient(const Point& a, const Point& b, const Point& c) {
  const Rational cx(c.x), cy(c.y);
  const Rational det = (Rational(a.x) - cx) * (Rational(b.y) - cy) - (Rational(a.y) - cy) * (Rational(b.x) - cx);
  return det.sign();
}

int exactInCircle(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto row = [&](const Point& p) {
    const Rational x = Rational(p.x) - Rational(d.x), y = Rational(p.y) - Rational(d.y);
    return std::array<Rational, 3>{x, y, x * x + y * y};
  };
  const auto r = row(a), s = row(b), t = row(c);
  const Rational det =
      r[0] * (s[1] * t[2] - s[2] * t[1]) - r[1] * (s[0] * t[2] - s[2] * t[0]) + r[2] * (s[0] * t[1] - s[1] * t[0]);
  return det.sign();
}

double nudged(double v, int ulps) {
  const double to = ulps < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) v = std::nextafter(v, to);
  return v;
}

void expectOrient(const Point& a, const Point& b, const Point& c) {
  const int sign = exactOrient(a, b, c);
  ASSERT_EQ(orient2d(a, b, c), sign);
  ASSERT_EQ(orient2d(b, c, a), sign);
  ASSERT_EQ(orient2d(c, a, b), sign);
  ASSERT_EQ(orient2d(b, a, c), -sign);
  ASSERT_EQ(orient2d(a, c, b), -sign);
  ASSERT_EQ(orient2d(c, b, a), -sign);
}

void expectInCircle(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int sign = exactInCircle(a, b, c, d);
  ASSERT_EQ(inCircle(a, b, c, d), sign);
  ASSERT_EQ(inCircle(b, c, a, d), sign);
  ASSERT_EQ(inCircle(c, a, b, d), sign);
  ASSERT_EQ(inCircle(b, a, c, d), -sign);
  // Swapping the fourth point with another also changes the sign.
  ASSERT_EQ(inCircle(a, b, d, c), -sign);
  ASSERT_EQ(inCircle(d, b, c, a), -sign);
}

class Predicates : public ::testing::TestWithParam<unsigned> {
 protected:
  std::mt19937_64 random_{GetParam()};

  Point somewhere(double size, const Point& offset) {
    const double x = uniform(random_, -size, size);
    return {offset.x + x, offset.y + uniform(random_, -size, size)};
  }
  int few() { return static_cast<int>(random_() % 7) - 3; }
};

TEST_P(Predicates, RandomPointsOfAllSizes) {
  for (int exponent = -60; exponent <= 60; exponent += 4) {
    const double size = std::ldexp(1.0, exponent);
    // Far from the origin, differences cancel.
    for (const double far : {0.0, 1.0, 1e7, 1e14}) {
      const Point offset{far * size, -0.3 * far * size};
      for (int i = 0; i < 5; ++i) {
        const Point a = somewhere(size, offset), b = somewhere(size, offset), c = somewhere(size, offset),
                    d = somewhere(size, offset);
        expectOrient(a, b, c);
        expectInCircle(a, b, c, d);
      }
    }
  }
}

TEST_P(Predicates, NearlyCollinear) {
  for (const double far : {0.0, 1.0, 1e6}) {
    for (int i = 0; i < 200; ++i) {
      const Point a = somewhere(1.0, {far, far}), b = somewhere(1.0, {far, far});
      const double s = uniform(random_, -2.0, 3.0);
      const Point c{nudged(a.x + s * (b.x - a.x), few()), nudged(a.y + s * (b.y - a.y), few())};
      expectOrient(a, b, c);
      expectInCircle(a, b, c, somewhere(1.0, {far, far}));
    }
  }
}

TEST_P(Predicates, ExactlyCollinearAndOneUlpOff) {
  for (int i = 0; i < 200; ++i) {
    // Integers: the third point lies exactly on the line.
    const auto whole = [&] { return static_cast<double>(static_cast<int>(random_() % 2'000'001) - 1'000'000); };
    const Point a{whole(), whole()}, step{whole(), whole()};
    const double m = static_cast<double>(random_() % 1000 + 1);
    const Point b{a.x + step.x, a.y + step.y}, c{a.x + m * step.x, a.y + m * step.y};
    ASSERT_EQ(orient2d(a, b, c), 0);
    for (const int ulp : {-1, 1}) {
      expectOrient(a, b, {nudged(c.x, ulp), c.y});
      expectOrient(a, b, {c.x, nudged(c.y, ulp)});
      expectOrient({nudged(a.x, ulp), a.y}, b, c);
    }
  }
}

TEST_P(Predicates, NearlyCocircular) {
  for (const double far : {0.0, 1.0, 1e6}) {
    for (int i = 0; i < 100; ++i) {
      std::array<Point, 4> p;
      for (Point& q : p) {
        const double at = uniform(random_, 0.0, 6.28);
        q = {nudged(far + std::cos(at), few()), nudged(far - std::sin(at), few())};
      }
      expectInCircle(p[0], p[1], p[2], p[3]);
    }
  }
}

TEST_P(Predicates, ExactlyCocircularAndOneUlpOff) {
  // Integer points on the circle of radius 65, which has many.
  const std::array<Point, 9> circle{
      {{65, 0}, {63, 16}, {60, 25}, {56, 33}, {52, 39}, {39, 52}, {-33, 56}, {-60, -25}, {16, -63}}};
  for (int i = 0; i < 200; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random_() % 40) - 20);
    const double dx = static_cast<double>(random_() % 1000), dy = static_cast<double>(random_() % 1000);
    const auto pick = [&] {
      const Point q = circle[random_() % circle.size()];
      return Point{scale * (q.x + dx), scale * (q.y + dy)};
    };
    const Point a = pick(), b = pick(), c = pick(), d = pick();
    ASSERT_EQ(inCircle(a, b, c, d), 0);
    for (const int ulp : {-1, 1}) {
      expectInCircle(a, b, c, {nudged(d.x, ulp), d.y});
      expectInCircle(a, b, c, {d.x, nudged(d.y, ulp)});
      expectInCircle({nudged(a.x, ulp), a.y}, b, c, d);
    }
  }
}

// The parameter is the seed, and GoogleTest prints it.
INSTANTIATE_TEST_SUITE_P(Seeds, Predicates, ::testing::Range(1u, 5u));

TEST(PredicatesSigns, AsDocumented) {
  EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(orient2d({0, 0}, {0, 1}, {1, 0}), -1);
  EXPECT_EQ(orient2d({0, 0}, {1, 1}, {2, 2}), 0);
  EXPECT_EQ(inCircle({0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}), 1);
  EXPECT_EQ(inCircle({0, 0}, {1, 0}, {0, 1}, {2, 2}), -1);
  EXPECT_EQ(inCircle({0, 0}, {1, 0}, {0, 1}, {1, 1}), 0);
}

TEST(PredicatesSigns, EqualPoints) {
  const Point a{0.1, 0.7}, b{0.3, -0.2}, c{1e-9, 5.0};
  expectOrient(a, a, b);
  expectOrient(a, a, a);
  expectInCircle(a, b, c, a);
  expectInCircle(a, b, c, c);
}

// Overflow and underflow of products must not change the sign.
TEST(PredicatesSigns, BeyondTheRangeOfProducts) {
  std::mt19937_64 random(7);
  for (const int exponent : {-1040, -900, -540, -535, -270, -268, -266, 260, 500, 900}) {
    for (int i = 0; i < 50; ++i) {
      std::array<Point, 4> p;
      for (Point& q : p) {
        const double x = uniform(random, -1.0, 1.0);
        q = {std::ldexp(x, exponent), std::ldexp(uniform(random, -1.0, 1.0), exponent)};
      }
      SCOPED_TRACE(::testing::Message() << "exponent " << exponent << ", try " << i);
      expectOrient(p[0], p[1], p[2]);
      expectInCircle(p[0], p[1], p[2], p[3]);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace coastmesh
