// Whether a polygon contains a place, against the rule applied to each of its edges.
#include "gis/rules/area_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace coastmesh {
namespace {

bool isOdd(const Ring& ring, const Point& p) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + ring.size() - 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

bool isIn(const Polygon& polygon, const Point& p, const RulePlane& plane) {
  const auto isInAnyTurn = [&](const Ring& ring) {
    return std::ranges::any_of(plane.turns(), [&](double turn) { return isOdd(ring, {p.x + turn, p.y}); });
  };
  bool inside = isInAnyTurn(polygon.outer);
  for (const Ring& hole : polygon.holes) inside = inside != isInAnyTurn(hole);
  return inside;
}

// Winds so much that many rays cross it often. Every fourth point has the coordinates of a lattice.
Ring windingRing(const Point& centre, double radius, std::size_t points, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0.5, 1.0);
  Ring ring;
  for (std::size_t i = 0; i < points; ++i) {
    const double angle = 6.283 * static_cast<double>(i) / static_cast<double>(points), r = radius * share(random);
    Point p{centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)};
    if (i % 4 == 0) p = {std::round(16.0 * p.x) / 16.0, std::round(16.0 * p.y) / 16.0};
    ring.push_back(p);
  }
  return ring;
}

void expectSame(const Polygon& polygon, bool geographic, const Point& centre, double radius, std::mt19937& random) {
  const AreaSearch area(polygon);
  const RulePlane plane(geographic);
  std::uniform_real_distribution<double> offset(-1.1 * radius, 1.1 * radius);
  std::vector<Point> places(polygon.outer);  // points of the ring itself, and on its edges
  for (std::size_t i = 0; i + 1 < polygon.outer.size(); ++i) {
    const Point &a = polygon.outer[i], &b = polygon.outer[i + 1];
    places.push_back({(a.x + b.x) / 2.0, (a.y + b.y) / 2.0});
    places.push_back({b.x, a.y});
  }
  for (int i = 0; i < 2000; ++i) {
    const Point p{centre.x + offset(random), centre.y + offset(random)};
    places.push_back(p);
    places.push_back({std::round(16.0 * p.x) / 16.0, std::round(16.0 * p.y) / 16.0});
    places.push_back({p.x - 360.0, p.y});
  }
  std::size_t inside = 0;
  for (const Point& p : places) {
    const bool expected = isIn(polygon, p, plane);
    EXPECT_EQ(area.contains(p, plane), expected) << p.x << ' ' << p.y;
    inside += expected;
  }
  EXPECT_GT(inside, places.size() / 20);
  EXPECT_LT(inside, places.size() * 9 / 10);
}

TEST(AreaSearch, IsTheRuleForEachEdge) {
  std::mt19937 random(20261128);
  for (const std::size_t points : {3u, 20u, 31u, 32u, 33u, 300u, 2000u}) {
    const Point centre{179.5, 10.0};
    Polygon polygon{windingRing(centre, 4.0, points, random), {}};
    if (points > 20) {
      polygon.holes.push_back(windingRing(centre, 1.5, points / 2, random));
      polygon.holes.push_back(windingRing({centre.x - 2.5, centre.y}, 0.5, 5, random));
    }
    expectSame(polygon, true, centre, 4.0, random);
    expectSame(polygon, false, centre, 4.0, random);
  }
}

// In metres far from the origin, where rounding of the rays' crossings is coarse.
TEST(AreaSearch, IsTheRuleForEachEdgeFarFromTheOrigin) {
  std::mt19937 random(7);
  const Point centre{5e8, 4e6};
  expectSame({windingRing(centre, 2.0, 1000, random), {}}, false, centre, 2.0, random);
}

TEST(AreaSearch, APlaceOnTheSideOfTwoPolygonsIsInOne) {
  Ring left, right;  // of a side with 100 points
  for (int i = 0; i <= 100; ++i) {
    const Point p{std::sin(0.3 * i) / 4.0, i / 8.0};
    left.push_back(p);
    right.push_back(p);
  }
  left.insert(left.end(), {{-5.0, 12.5}, {-5.0, 0.0}});
  right.insert(right.end(), {{5.0, 12.5}, {5.0, 0.0}});
  const std::vector<Point> side(left.begin(), left.begin() + 101);
  const AreaSearch of_left({left, {}}), of_right({right, {}});
  const RulePlane plane(false);
  for (std::size_t i = 1; i + 1 < side.size(); ++i)
    EXPECT_NE(of_left.contains(side[i], plane), of_right.contains(side[i], plane)) << i;
}

}  // namespace
}  // namespace coastmesh
