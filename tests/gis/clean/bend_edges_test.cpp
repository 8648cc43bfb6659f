#include "gis/clean/bend_edges.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>

#include "core/metric.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

const GeographicLib::Geodesic& wgs84Geodesic() { return GeographicLib::Geodesic::WGS84(); }

Coastline bent(const Ring& ring, EdgeLine line, double tolerance_m, SurfaceKind kind = SurfaceKind::Plane) {
  Coastline coastline = coastlineOf({polygonFeature(1, ring)}, wgs84());
  const Projection projection = Projection::fitted(coastline, {0}, kind);
  const std::size_t count = bendEdges(coastline, {0}, projection, line, tolerance_m);
  EXPECT_EQ(coastline.features[0].polygons[0].outer.size(), ring.size() + count);
  return coastline;
}

// The largest distance on the ground, metres, from the middle of an edge's line to the edge in the plane.
double furthestOff(const Ring& ring, EdgeLine line, const Projection& projection) {
  double most = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    Point middle{a.x + std::remainder(b.x - a.x, 360.0) / 2, (a.y + b.y) / 2};
    if (line == EdgeLine::Geodesic) {
      double length = 0.0, azimuth = 0.0, other = 0.0;
      wgs84Geodesic().Inverse(a.y, a.x, b.y, b.x, length, azimuth, other);
      wgs84Geodesic().Direct(a.y, a.x, azimuth, length / 2, middle.y, middle.x);
    }
    const Point x = projection.forward(middle);
    const double off = squaredDistanceToSegment(x, projection.forward(a), projection.forward(b));
    most = std::max(most, std::sqrt(off) / projection.scaleAt(x));
  }
  return most;
}

const Ring kOcean{{-60, -10}, {20, -30}, {35, 40}, {-50, 55}};

TEST(BendEdges, EdgesKeepWithinTheToleranceOfTheirLines) {
  for (const SurfaceKind kind : {SurfaceKind::Plane, SurfaceKind::Ellipsoid}) {
    const Projection projection = Projection::fitted(coastlineOf({polygonFeature(1, kOcean)}, wgs84()), {0}, kind);
    for (const EdgeLine line : {EdgeLine::LonLat, EdgeLine::Geodesic}) {
      EXPECT_GT(furthestOff(kOcean, line, projection), 1e5);
      std::size_t before = 0;
      for (const double tolerance_m : {10000.0, 1000.0, 100.0, 1.0}) {
        const Ring ring = bent(kOcean, line, tolerance_m, kind).features[0].polygons[0].outer;
        EXPECT_LE(furthestOff(ring, line, projection), tolerance_m);
        EXPECT_GT(ring.size(), before);
        // Twice the points make a quarter of the deviation: at most about 4 times the necessary number.
        EXPECT_LT(ring.size(), 4.0 * 10.0 * std::sqrt(1e6 / tolerance_m));
        before = ring.size();
      }
    }
    EXPECT_EQ(bent(kOcean, EdgeLine::Plane, 1.0, kind).features[0].polygons[0].outer, kOcean);
  }
}

TEST(BendEdges, PointsLieOnTheLine) {
  const Ring straight = bent(kOcean, EdgeLine::LonLat, 100.0).features[0].polygons[0].outer;
  const auto second = std::ranges::find(straight, kOcean[1]);
  for (auto p = straight.begin(); p != second; ++p) EXPECT_NEAR((p->y - -10.0) * 80.0, (p->x - -60.0) * -20.0, 1e-9);
  const Ring bow = bent(kOcean, EdgeLine::Geodesic, 100.0).features[0].polygons[0].outer;
  double whole = 0.0, sum = 0.0;
  wgs84Geodesic().Inverse(-10, -60, -30, 20, whole);
  for (auto p = bow.begin(); *p != kOcean[1]; ++p) {
    double piece = 0.0;
    wgs84Geodesic().Inverse(p->y, p->x, (p + 1)->y, (p + 1)->x, piece);
    sum += piece;
  }
  EXPECT_NEAR(sum, whole, 1e-3);
}

// Two features that share an edge have the same points there, though in the other direction.
TEST(BendEdges, SharedEdgesStayShared) {
  const Ring west{{0, 40}, {20, 40}, {27, 60}, {0, 60}}, east{{20, 40}, {40, 42}, {40, 61}, {27, 60}};
  for (const EdgeLine line : {EdgeLine::LonLat, EdgeLine::Geodesic}) {
    Coastline coastline = coastlineOf({polygonFeature(1, west), polygonFeature(2, east)}, wgs84());
    const Projection projection = Projection::fitted(coastline, {0, 1});
    bendEdges(coastline, {0, 1}, projection, line, 10.0);
    Ring a = coastline.features[0].polygons[0].outer, b = coastline.features[1].polygons[0].outer;
    const auto from = std::ranges::find(a, Point{20, 40}), to = std::ranges::find(a, Point{27, 60});
    ASSERT_LT(from, to);
    EXPECT_GT(to - from, 3);
    for (auto p = from; p != to; ++p) EXPECT_NE(std::ranges::find(b, *p), b.end());
  }
}

TEST(BendEdges, AcrossTheAntimeridianTheShorterWay) {
  const Ring pacific{{150, -10}, {-150, -20}, {-140, 30}, {160, 35}};
  for (const EdgeLine line : {EdgeLine::LonLat, EdgeLine::Geodesic}) {
    const Ring ring = bent(pacific, line, 1000.0).features[0].polygons[0].outer;
    for (const Point& p : ring) {
      EXPECT_GE(std::abs(p.x), 140.0);
      EXPECT_LE(std::abs(p.x), 180.0);
    }
    // The same with unwrapped longitudes.
    Ring turned = pacific;
    for (Point& p : turned)
      if (p.x < 0) p.x += 360.0;
    const Ring on = bent(turned, line, 1000.0).features[0].polygons[0].outer;
    ASSERT_EQ(on.size(), ring.size());
    for (std::size_t i = 0; i < on.size(); ++i) {
      EXPECT_NEAR(std::remainder(on[i].x - ring[i].x, 360.0), 0.0, 1e-9);
      EXPECT_NEAR(on[i].y, ring[i].y, 1e-9);
    }
  }
}

// A tolerance of a millimetre over half of the Earth: the number of points is capped.
TEST(BendEdges, AreBounded) {
  EXPECT_LE(bent(kOcean, EdgeLine::LonLat, 0.001).features[0].polygons[0].outer.size(), 4u * 4096u);
}

TEST(BendEdges, FramesAreLeftAlone) {
  Coastline coastline = coastlineOf({polygonFeature(1, kOcean)}, wgs84());
  const Projection projection = Projection::fitted(coastline, {0});
  coastline.features[0].use = FeatureUse::Frame;
  EXPECT_EQ(bendEdges(coastline, {0}, projection, EdgeLine::Geodesic, 1.0), 0u);
}

}  // namespace
}  // namespace coastmesh
