#include "gis/clean/clean_touches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gis/clean/clean.hpp"
#include "gis/crs/crs.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

// The number of points inserted into edge ab because of `p`.
std::size_t putOn(const Point& a, const Point& b, const Point& p, double tolerance) {
  std::vector<Point> edge{a, b}, other{p, {p.x + 50, p.y + 70}};
  insertTouchingPoints({{&edge, false}, {&other, false}}, tolerance);
  if (edge.size() == 3) {
    EXPECT_EQ(edge[1], p);
  }
  return edge.size() - 2;
}

TEST(CleanTouches, WhatRoundingAloneMovesOffAnEdgeLiesOnIt) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> lon(-180, 180), lat(-90, 90), part(0.1, 0.9);
  int exact = 0;
  for (int k = 0; k < 1000; ++k) {
    const Point a{lon(random), lat(random)}, b{a.x + part(random), a.y + part(random)};
    const double t = part(random);
    const Point on{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    EXPECT_EQ(putOn(a, b, on, 0), 1u) << k;
    EXPECT_EQ(putOn(a, b, {on.x + 1e-11, on.y - 1e-11}, 0), 0u) << k;
    exact += (on.x - a.x) * (b.y - a.y) == (on.y - a.y) * (b.x - a.x);
  }
  EXPECT_LT(exact, 500);
}

TEST(CleanTouches, ToleranceIsADistance) {
  EXPECT_EQ(putOn({0, 0}, {100, 0}, {40, 0.009}, 0.01), 1u);
  EXPECT_EQ(putOn({0, 0}, {100, 0}, {40, -0.011}, 0.01), 0u);
  EXPECT_EQ(putOn({0, 0}, {0, 100}, {0.009, 40}, 0.01), 1u);
  EXPECT_EQ(putOn({0, 0}, {80, 60}, {40 + 0.005, 30 - 0.007}, 0.01), 1u);
  EXPECT_EQ(putOn({0, 0}, {80, 60}, {40 + 0.009, 30 - 0.009}, 0.01), 0u);
}

TEST(CleanTouches, WhatIsNearToAnEndIsLeftToSnapping) {
  EXPECT_EQ(putOn({0, 0}, {100, 0}, {0.005, 0.005}, 0.01), 0u);
  EXPECT_EQ(putOn({0, 0}, {100, 0}, {99.995, 0.005}, 0.01), 0u);
  EXPECT_EQ(putOn({0, 0}, {100, 0}, {-0.005, 0}, 0.01), 0u);
  EXPECT_EQ(putOn({0, 0}, {100, 0}, {0.005, 0}, 0.01), 1u);  // exactly on it
}

TEST(CleanTouches, SinglePointsArePutOnEdges) {
  std::vector<Point> edge{{0, 0}, {100, 50}}, on{{40, 20}}, at_end{{100, 50}}, off{{40, 21}};
  const auto touches = insertTouchingPoints({{&edge, false}, {&on, false}, {&at_end, false}, {&off, false}}, 0.01);
  EXPECT_EQ(edge, (std::vector<Point>{{0, 0}, {40, 20}, {100, 50}}));
  EXPECT_EQ(touches.size(), 1u);
  EXPECT_EQ(on.size() + at_end.size() + off.size(), 3u);
}

// Straight edges in degrees are curves in the plane: points on them would lie beside them by metres.
TEST(CleanTouches, RequestedPointsOnEdgesLieOnTheShore) {
  Feature gauges;
  gauges.use = FeatureUse::Constraint;
  gauges.points = {{5.13, 50}, {5.17, 50.4}, {5.2, 50.2}};
  const Coastline coastline = coastlineOf({polygonFeature(1, square(5, 50, 0.4)), gauges}, wgs84());
  const Projection projection = Projection::fitted(coastline, {0, 1});
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0, 1}, projection, CleanOptions{}, report);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::OutsideWater)], 0u);
  ASSERT_EQ(domain.asked.size(), 3u);
  for (const VertexId v : domain.asked) {
    const auto ends =
        std::ranges::count_if(domain.pslg.segments, [v](const Segment& s) { return s.a == v || s.b == v; });
    EXPECT_EQ(ends, domain.input_points[v] == gauges.points[2] ? 0 : 2);
  }
}

// A ring that runs back along itself in degrees, up to rounded decimals. In the plane, where its sides are straight
// between other points, they were centimetres apart over a kilometre. Tests all starting points and both directions.
TEST(CleanTouches, ASpikeThatRunsBackIsNone) {
  Ring ring{{-48.50508505085051, -25.523976958566983},
            {-48.48708487084869, -25.535796999456167},
            {-48.4690846908469, -25.54423988580558},
            {-48.47988479884799, -25.554371349424876},
            {-48.483484834848355, -25.55774850396464},
            {-48.47628476284763, -25.550994194885106},
            {-48.490684906849054, -25.56450281304417},
            {-48.6, -25.6},
            {-48.6, -25.5}};
  for (std::size_t first = 0; first < ring.size(); ++first) {
    std::ranges::rotate(ring, ring.begin() + 1);
    for (int way = 0; way < 2; ++way) {
      std::ranges::reverse(ring);
      const Coastline coastline =
          coastlineOf({polygonFeature(1, ring), polygonFeature(2, square(-49, -26, 1))}, wgs84());
      const Projection projection = Projection::fitted(coastline, {0, 1});
      CleanReport report;
      const Domain domain = cleanFeatures(coastline, {0, 1}, projection, CleanOptions{}, report);
      const auto at = [&](VertexId v) { return domain.pslg.points[v]; };
      // No vertex lies within a metre of a side that it does not end.
      for (const Segment& s : domain.pslg.segments) {
        const Point a = at(s.a), b = at(s.b);
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        for (VertexId v = 0; v < domain.pslg.points.size(); ++v) {
          if (v == s.a || v == s.b) continue;
          const Point p = at(v);
          const double along = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length;
          if (along < 0 || along > length) continue;
          EXPECT_GT(std::abs((p.x - a.x) * (b.y - a.y) - (p.y - a.y) * (b.x - a.x)) / length, 1.0)
              << first << ": vertex " << v << " beside " << s.a << ' ' << s.b;
        }
      }
      EXPECT_GT(report.counts[static_cast<std::size_t>(EditKind::OverlappingEdge)], 0u);
    }
  }
}

}  // namespace
}  // namespace coastmesh
