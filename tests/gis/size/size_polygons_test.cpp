// Polygons with sizes in planes that show most of the globe, or tear it: inside is what longitudes and latitudes say.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "gis/size/size_features.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

constexpr double kSize = 500.0;

// A box of longitudes and latitudes, which may reach past 180.
struct DegreeBox {
  double west, south, east, north;

  bool holds(const Point& p) const {
    for (const double turn : {-360.0, 0.0, 360.0})
      if (p.x + turn > west && p.x + turn < east && p.y > south && p.y < north) return true;
    return false;
  }
  bool isNearBorder(const Point& p, double degrees) const {
    const DegreeBox outer{west - degrees, south - degrees, east + degrees, north + degrees};
    const DegreeBox inner{west + degrees, south + degrees, east - degrees, north - degrees};
    return outer.holds(p) && !inner.holds(p);
  }
  // In edges of 5 degrees, with longitudes that jump at 180.
  Ring ring() const {
    constexpr double kStep = 5.0;
    Ring ring;
    for (double x = west; x < east; x += kStep) ring.push_back({x, south});
    for (double y = south; y < north; y += kStep) ring.push_back({east, y});
    for (double x = east; x > west; x -= kStep) ring.push_back({x, north});
    for (double y = north; y > south; y -= kStep) ring.push_back({west, y});
    for (Point& p : ring) p.x -= p.x > 180.0 ? 360.0 : 0.0;
    return ring;
  }
};

SizedFeatures sizedIn(const DegreeBox& box) {
  SizedFeatures features;
  features.crs = wgs84();
  SizedFeatures::Part& part = features.parts.emplace_back();
  part.polygons = {{box.ring(), {}}};
  part.size_m = kSize;
  part.rate = 0.2;
  return features;
}

// Compares sizes inside, and their bounds, at places in a box of degrees.
void expectInside(const DegreeBox& box, const Projection& projection, const DegreeBox& places) {
  const auto scale = [&](const Point& place) { return projection.scaleAt(place); };
  const auto fields = featureFields(sizedIn(box), projection, scale);
  ASSERT_EQ(fields.size(), 2u);
  for (double lon = places.west; lon <= places.east; lon += 3.7) {
    for (double lat = places.south; lat <= places.north; lat += 3.1) {
      const Point given{lon, lat}, place = projection.forward(given);
      if (box.isNearBorder(given, 1.5) || !(std::abs(place.x) + std::abs(place.y) < 1e10)) continue;
      const double expected = box.holds(given) ? kSize : std::numeric_limits<double>::infinity();
      double size = 0.0;
      fields[1]->sample(std::span(&place, 1), std::span(&size, 1));
      EXPECT_EQ(size, expected) << lon << ", " << lat << " box from " << box.west;
      const SizeBox around{place, 1000.0 * scale(place)};
      SizeRange range;
      fields[1]->bound(std::span(&around, 1), std::span(&range, 1));
      EXPECT_EQ(range.low, expected) << lon << ", " << lat << " box from " << box.west;
      EXPECT_EQ(range.high, expected) << lon << ", " << lat << " box from " << box.west;
    }
  }
}

TEST(SizePolygons, MayHoldTheAntipode) {
  const Projection projection =
      Projection::fitted(coastlineOf({polygonFeature(0, square(-5, -5, 10))}, wgs84()), {0}, SurfaceKind::Ellipsoid);
  const DegreeBox globe{-179.3, -85.0, 179.0, 85.0};
  for (const DegreeBox& box : {DegreeBox{160, -20, 200, 30}, DegreeBox{100, -60, 260, 60}, DegreeBox{20, -40, 60, 40},
                               DegreeBox{-100, -70, 100, 70}})
    expectInside(box, projection, globe);
}

// Meridians 90 degrees from the central one, and the equator beyond, have no place near their neighbours there.
TEST(SizePolygons, MayReachPastTransverseMercator) {
  const Projection projection =
      Projection::fitted(coastlineOf({polygonFeature(0, {{10, -10}, {14, -10}, {14, 30}, {10, 30}})}, wgs84()), {0});
  ASSERT_NE(projection.description().find("transverse Mercator"), std::string::npos);
  for (const DegreeBox& box :
       {DegreeBox{-90, -80, 100, 80}, DegreeBox{-115, -80, 125, 80}, DegreeBox{-180, -85, 180, 85},
        DegreeBox{-110, -35, 20, 15}, DegreeBox{160, -30, 230, 30}, DegreeBox{95, -30, 130, 30}})
    expectInside(box, projection, {8, -15, 16, 35});
}

}  // namespace
}  // namespace coastmesh
