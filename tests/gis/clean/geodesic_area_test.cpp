#include "gis/clean/geodesic_area.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

double areaOf(const Ring& ring, const Crs& crs = wgs84()) {
  return geodesicArea(coastlineOf({polygonFeature(1, ring)}, crs), {0});
}

const double kGlobe = GeographicLib::Geodesic::WGS84().EllipsoidArea();

TEST(GeodesicArea, OfOneDegreeAtTheEquator) {
  const Ring ring = square(0, 0, 1);
  EXPECT_NEAR(areaOf(ring), 12308.778e6, 1e3);  // the published figure for WGS 84
  Ring reversed = ring;
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_NEAR(areaOf(reversed), areaOf(ring), 1e-3);
}

TEST(GeodesicArea, HolesAreTakenOutAndMembersSummed) {
  const Coastline coastline = coastlineOf({polygonFeature(1, square(0, 40, 4), {square(1, 41, 1)}),
                                           polygonFeature(2, square(9, 40, 1)), polygonFeature(3, {})},
                                          wgs84());
  EXPECT_NEAR(geodesicArea(coastline, {0}), areaOf(square(0, 40, 4)) - areaOf(square(1, 41, 1)), 1);
  EXPECT_NEAR(geodesicArea(coastline, {0, 1, 2}), geodesicArea(coastline, {0}) + geodesicArea(coastline, {1}), 1);
}

// Slivers whose orientation is reversed by geodesics.
TEST(GeodesicArea, OfNoDomainIsAllOfTheGlobe) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Point a{170.0 * anywhere(random), 80.0 * anywhere(random)}, step{1e-3 * anywhere(random), 1e-3};
    Domain domain;
    domain.input_points = {a, {a.x + step.x, a.y + step.y}, {a.x + 0.5 * step.x, a.y + 0.5 * step.y}};
    domain.pslg.points = domain.input_points;
    for (VertexId v = 0; v < 3; ++v) domain.pslg.segments.push_back({v, (v + 1) % 3, 0, 0, kOutside});
    EXPECT_LT(geodesicArea(domain, wgs84()), 1.0) << i;
  }
}

TEST(GeodesicArea, LongitudesMayRunPast180OrJumpThere) {
  const double expected = areaOf(square(-2, -17, 4));
  EXPECT_NEAR(areaOf(square(178, -17, 4)), expected, 1);
  EXPECT_NEAR(areaOf({{178, -17}, {-178, -17}, {-178, -13}, {178, -13}}), expected, 1);
}

TEST(GeodesicArea, AroundAPole) {
  Ring cap;
  for (int lon = -180; lon < 180; lon += 10) cap.push_back({static_cast<double>(lon), 80});
  Ring plate_carree = cap;
  plate_carree.push_back({180, 80});
  plate_carree.push_back({180, 90});
  plate_carree.push_back({-180, 90});
  EXPECT_NEAR(areaOf(cap) / areaOf(plate_carree), 1, 1e-9);
  EXPECT_NEAR(areaOf(cap) / (kGlobe * (1 - std::sin(80 * M_PI / 180)) / 2), 1, 2e-2);
}

TEST(GeodesicArea, OfMoreThanHalfTheGlobe) {
  Ring ocean;
  for (int lon = -180; lon <= 180; lon += 10) ocean.push_back({static_cast<double>(lon), -70});
  ocean.push_back({180, 90});
  ocean.push_back({-180, 90});
  Ring cap;
  for (int lon = -180; lon < 180; lon += 10) cap.push_back({static_cast<double>(lon), -70});
  EXPECT_NEAR(areaOf(ocean) / (kGlobe - areaOf(cap)), 1, 1e-12);
  std::reverse(ocean.begin(), ocean.end());
  EXPECT_NEAR(areaOf(ocean) / (kGlobe - areaOf(cap)), 1, 1e-12);
}

// Edges of all lengths, at all latitudes, against the library's own sum.
TEST(GeodesicArea, OfShortAndLongEdgesAlike) {
  std::mt19937_64 random(7);
  for (const double lat : {-88.0, -60.0, -20.0, 0.0, 35.0, 51.5, 75.0, 87.0}) {
    for (const double radius : {1e-5, 1e-3, 0.05, 0.5, 1.0}) {
      for (const std::size_t n : {3u, 10u, 300u}) {
        Ring ring = starRing(random, {0, 0}, radius, n);
        for (Point& p : ring) p = {120 + p.x / std::cos(lat * M_PI / 180), lat + p.y};
        GeographicLib::PolygonArea polygon(GeographicLib::Geodesic::WGS84());
        for (const Point& p : ring) polygon.AddPoint(p.y, p.x);
        double perimeter, area;
        polygon.Compute(false, true, perimeter, area);
        // The library's rounding error: some square centimetres, whatever the area.
        EXPECT_NEAR(areaOf(ring), std::abs(area), 1e-8 * std::abs(area) + 3e-4)
            << "latitude " << lat << ", radius " << radius << ", " << n;
      }
    }
  }
}

TEST(GeodesicArea, OfNothingIsNothing) {
  EXPECT_NEAR(areaOf({{10, 50}, {11, 51}, {10, 50}, {11, 51}}), 0, 1e-3);
  EXPECT_NEAR(areaOf({{10, 50}, {11, 50}}), 0, 1e-3);
  EXPECT_NEAR(areaOf({{0, 0}, {1, 0}, {2, 0}}), 0, 1e-3);
  EXPECT_NEAR(areaOf({{2, 0}, {1, 0}, {0, 0}}), 0, 1e-3);
}

TEST(GeodesicArea, OfProjectedAndPlaneRings) {
  EXPECT_EQ(areaOf(square(1e6, 1e6, 3), Crs{}), 9);
  // On its central meridian UTM shrinks lengths by 0.9996.
  EXPECT_NEAR(areaOf(square(500000, 5e6, 1000), parseCrs("EPSG:32616")), 1e6 / (0.9996 * 0.9996), 1);
}

}  // namespace
}  // namespace coastmesh
