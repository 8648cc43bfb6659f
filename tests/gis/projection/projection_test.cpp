#include "gis/projection/projection.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <thread>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

// A rectangle of longitudes and latitudes with points along its sides.
Ring graticuleRing(double west, double east, double south, double north) {
  constexpr int kSteps = 8;
  Ring ring;
  for (int i = 0; i < kSteps; ++i) ring.push_back({west + (east - west) * i / kSteps, south});
  for (int i = 0; i < kSteps; ++i) ring.push_back({east, south + (north - south) * i / kSteps});
  for (int i = 0; i < kSteps; ++i) ring.push_back({east - (east - west) * i / kSteps, north});
  for (int i = 0; i < kSteps; ++i) ring.push_back({west, north - (north - south) * i / kSteps});
  return ring;
}

Projection fit(const Ring& ring, const Crs& crs = wgs84()) {
  return Projection::fitted(coastlineOf({polygonFeature(1, ring)}, crs), {0});
}

double wrapped(double degrees) { return std::remainder(degrees, 360.0); }

// Tests forward and inverse, and scale and conformality against geodesics.
void expectFaithful(const Projection& projection, const Point& lonlat) {
  SCOPED_TRACE(projection.description() + " at " + std::to_string(lonlat.x) + ", " + std::to_string(lonlat.y));
  const Point plane = projection.forward(lonlat);
  const Point back = projection.inverse(plane);
  EXPECT_NEAR(back.y, lonlat.y, 1e-9);
  EXPECT_NEAR(wrapped(back.x - lonlat.x) * std::cos(lonlat.y * M_PI / 180), 0, 1e-9);
  const Point again = projection.forward(back);
  EXPECT_NEAR(again.x, plane.x, 1e-4);
  EXPECT_NEAR(again.y, plane.y, 1e-4);

  const auto& geodesic = GeographicLib::Geodesic::WGS84();
  constexpr double kStep = 100;  // metres on the ground
  const double scale = projection.scaleAt(plane);
  std::vector<Point> around;
  for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
    double lat, lon;
    geodesic.Direct(lonlat.y, lonlat.x, azimuth, kStep, lat, lon);
    around.push_back(projection.forward({lon, lat}));
  }
  for (const int i : {0, 1}) {
    const double length = std::hypot(around[i].x - around[i + 2].x, around[i].y - around[i + 2].y);
    EXPECT_NEAR(length / (2 * kStep * scale), 1, 1e-6);
  }
  const double dot = (around[0].x - around[2].x) * (around[1].x - around[3].x) +
                     (around[0].y - around[2].y) * (around[1].y - around[3].y);
  EXPECT_NEAR(dot / (4 * kStep * kStep * scale * scale), 0, 1e-6);
}

struct Case {
  double west, east, south, north;
  const char* expected;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.west << ".." << c.east << ", " << c.south << ".." << c.north;
}

class FittedTo : public ::testing::TestWithParam<Case> {};

TEST_P(FittedTo, IsTheRightOneAndFaithful) {
  const Case& c = GetParam();
  const Ring ring = graticuleRing(c.west, c.east, c.south, c.north);
  const Projection projection = fit(ring);
  EXPECT_EQ(projection.description().find(c.expected), 0u) << projection.description();
  for (const Point& p : ring) expectFaithful(projection, p);
  for (const double u : {0.13, 0.5, 0.77}) {
    for (const double v : {0.09, 0.5, 0.91}) {
      expectFaithful(projection, {c.west + u * (c.east - c.west), c.south + v * (c.north - c.south)});
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Extents, FittedTo,
                         ::testing::Values(Case{-88, -86, 41, 46, "transverse Mercator"},    // Lake Michigan
                                           Case{-75, -68, -56, -18, "transverse Mercator"},  // Chile
                                           Case{178, 183, -47, -34, "transverse Mercator"},  // New Zealand, past 180
                                           Case{-0.01, 0.01, -1, 1, "transverse Mercator"},  // across the equator
                                           Case{27.4, 42, 40.9, 46.6, "Lambert"},            // Black Sea
                                           Case{95, 141, -11, 6, "Lambert"},                 // Indonesia
                                           Case{100, 120, -2, 2, "Lambert"},                 // Mercator, in effect
                                           Case{130, 150, -45, -40, "Lambert"},              // southern
                                           Case{170, 190, 50, 55, "Lambert"},                // Aleutians, past 180
                                           Case{-190, -170, 50, 55, "Lambert"},              // the same, from -180
                                           Case{4, 9, 52, 55, "oblique stereographic"},      // a roundish bay
                                           Case{0.001, 0.0016, 50, 50.0004, "oblique stereographic"},  // a pond
                                           Case{-80, -10, 0, 65, "oblique stereographic"},             // North Atlantic
                                           Case{120, 290, -60, 60, "oblique stereographic"},           // Pacific
                                           Case{-180, 180, 66, 89, "polar stereographic about the north pole"},
                                           Case{-180, 180, -85, -60, "polar stereographic about the south pole"},
                                           Case{-180, 180, 70, 90, "polar stereographic about the north pole"},
                                           Case{0, 360, -90, -50, "polar stereographic about the south pole"}));

TEST(Fitted, ThePointsOfTheInputComeBackOnTheSameTurnRoundTheGlobe) {
  for (const auto& [west, east] : {std::pair(170.0, 190.0), std::pair(-190.0, -170.0), std::pair(350.0, 359.0)}) {
    const Projection projection = fit(graticuleRing(west, east, 10, 15));
    for (const double x : {west, (west + east) / 2, east}) {
      EXPECT_NEAR(projection.inverse(projection.forward({x, 12})).x, x, 1e-9);
    }
  }
}

TEST(Fitted, BothSidesOfTheAntimeridianMeet) {
  Coastline coastline = coastlineOf(
      {polygonFeature(1, graticuleRing(177, 180, -18, -16)), polygonFeature(2, graticuleRing(-180, -178, -18, -16))},
      wgs84());
  const Projection projection = Projection::fitted(coastline, {0, 1});
  EXPECT_EQ(projection.forward({180, -17}), projection.forward({-180, -17}));
  EXPECT_LT(std::abs(projection.forward({180, -17}).x), 4e5);
  EXPECT_NEAR(projection.scaleAt(projection.forward({180, -17})), 1, 1e-2);
}

TEST(Fitted, TheWholeOceanIsSeenFromTheOtherSideOfItsLargestLand) {
  // The whole globe except a cap around 90°E 45°N and a smaller one around the south pole.
  Ring ocean = graticuleRing(-180, 180, -80, 90);
  Ring land;
  for (int i = 0; i < 72; ++i) {
    double lat, lon;
    GeographicLib::Geodesic::WGS84().Direct(45, 90, 5.0 * i, 2.5e6, lat, lon);
    land.push_back({lon, lat});
  }
  const Coastline coastline = coastlineOf({polygonFeature(1, ocean, {land})}, wgs84());
  const Projection projection = Projection::fitted(coastline, {0});
  EXPECT_EQ(projection.description().find("oblique stereographic"), 0u) << projection.description();
  for (const Ring* ring : {&ocean, &land}) {
    for (const Point& p : *ring) expectFaithful(projection, p);
  }
  for (int lon = -180; lon <= 180; lon += 30) {
    for (int lat = -80; lat <= 30; lat += 10) {
      expectFaithful(projection, {static_cast<double>(lon), static_cast<double>(lat)});
    }
  }
}

// Duplicate land is land all the same.
TEST(Fitted, LandMayBeThereTwice) {
  Ring land;
  for (int i = 0; i < 72; ++i) {
    double lat, lon;
    GeographicLib::Geodesic::WGS84().Direct(45, 90, 5.0 * i, 2.5e6, lat, lon);
    land.push_back({lon, lat});
  }
  Coastline coastline = coastlineOf(
      {polygonFeature(1, land), polygonFeature(2, land), polygonFeature(3, graticuleRing(-180, 180, -90, 90))},
      wgs84());
  coastline.features[0].use = coastline.features[1].use = FeatureUse::Land;
  coastline.features[2].use = FeatureUse::Frame;
  const Projection projection = Projection::fitted(coastline, {0, 1, 2});
  EXPECT_EQ(projection.description().find("oblique stereographic"), 0u) << projection.description();
  for (const Point& p : land) expectFaithful(projection, p);
}

TEST(Fitted, RefusesAGlobeWithoutLand) {
  Ring all;
  for (int lon = -180; lon <= 180; lon += 5) all.push_back({static_cast<double>(lon), -90});
  for (int lat = -85; lat <= 85; lat += 5) all.push_back({180, static_cast<double>(lat)});
  for (int lon = 180; lon >= -180; lon -= 5) all.push_back({static_cast<double>(lon), 90});
  EXPECT_THROW(fit(all), InputError);
}

TEST(Fitted, RefusesWhatIsNoLatitude) {
  try {
    fit({{500000, 5e6}, {510000, 5e6}, {510000, 5.1e6}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("EPSG:4326"), std::string::npos);
  }
}

TEST(Fitted, FromAProjectedCrs) {
  const Crs utm = parseCrs("EPSG:32616");
  const Ring ring{{450000, 4.6e6}, {550000, 4.6e6}, {550000, 5.1e6}, {450000, 5.1e6}};
  const Projection projection = fit(ring, utm);
  EXPECT_EQ(projection.description().find("transverse Mercator"), 0u);
  for (const Point& p : ring) {
    const Point back = projection.inverse(projection.forward(p));
    EXPECT_NEAR(back.x, p.x, 1e-4);
    EXPECT_NEAR(back.y, p.y, 1e-4);
  }
  // UTM's scale is 0.9996 on its central meridian, ours is 1.
  const Point a = projection.forward({500000, 4.8e6}), b = projection.forward({500000, 4.801e6});
  EXPECT_NEAR(std::hypot(a.x - b.x, a.y - b.y), 1000 / 0.9996, 1e-3);
}

// More than a hemisphere of water across the antimeridian, in Mercator: as in longitudes that go on past 180.
TEST(Fitted, FromAProjectedCrsAcrossTheAntimeridian) {
  const std::vector<Ring> rings{graticuleRing(105, 295, -75, 70), graticuleRing(115, 150, -38, -12),
                                graticuleRing(155, 200, 60, 72), graticuleRing(240, 285, -5, 40)};
  const Crs mercator = parseCrs("EPSG:3832");
  const CrsMap map(toOgr(wgs84()), toOgr(mercator));
  Coastline degrees = coastlineOf({}, wgs84()), metres = coastlineOf({}, mercator);
  for (const Ring& ring : rings) {
    Ring projected;
    for (const Point& p : ring) projected.push_back(map.forward(p));
    const FeatureUse use = degrees.features.empty() ? FeatureUse::Frame : FeatureUse::Land;
    degrees.features.push_back(polygonFeature(1, ring));
    metres.features.push_back(polygonFeature(1, projected));
    degrees.features.back().use = metres.features.back().use = use;
  }
  const Projection expected = Projection::fitted(degrees, allMembers(degrees));
  const Projection projection = Projection::fitted(metres, allMembers(metres));
  EXPECT_EQ(projection.description(), expected.description());
  for (const Point& p : {Point{180, 0}, {230, -40}, {110, -60}, {290, 60}}) {
    const Point plane = projection.forward(map.forward(p)), wanted = expected.forward(p);
    EXPECT_NEAR(std::hypot(plane.x - wanted.x, plane.y - wanted.y), 0, 1) << p.x;
  }
}

TEST(Fitted, ToGroupsOfTheirOwn) {
  const Coastline coastline = coastlineOf(
      {polygonFeature(1, graticuleRing(0, 1, 0, 3)), polygonFeature(2, graticuleRing(50, 59, 40, 42))}, wgs84());
  const std::vector<Projection> projections = Projection::fittedEach(coastline, {{0}, {1}});
  ASSERT_EQ(projections.size(), 2u);
  EXPECT_EQ(projections[0].description(), Projection::fitted(coastline, {0}).description());
  EXPECT_EQ(projections[1].description(), Projection::fitted(coastline, {1}).description());
}

TEST(Fitted, PlacesOnTheGroundAreThoseOfTheEllipsoid) {
  for (const bool north : {true, false}) {
    const Coastline coastline =
        coastlineOf({polygonFeature(1, graticuleRing(20, 80, north ? 35 : -75, north ? 75 : -35))}, wgs84());
    const Projection projection = Projection::fitted(coastline, {0}, SurfaceKind::Ellipsoid);
    ASSERT_TRUE(projection.surface().isCurved());
    std::vector<Point> plane{{0, 0}};
    for (const double latitude : {-90.0, -89.9999, -60.0, -1e-7, 0.0, 33.0, 89.5, 90.0})
      for (const double longitude : {-180.0, -91.0, 0.0, 47.0, 170.0})
        plane.push_back(projection.forward({longitude, latitude}));
    const GroundPlaces ground = projection.groundPlaces(plane);
    const auto& earth = GeographicLib::Geocentric::WGS84();
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const Point input = projection.inverse(plane[i]);
      EXPECT_EQ(ground.input[i], input);
      SpacePoint space;
      earth.Forward(input.y, input.x, 0.0, space.x, space.y, space.z);
      EXPECT_LT(distance(ground.space[i], space), 1e-8) << input.x << " " << input.y;
      EXPECT_NEAR(ground.measure[i], projection.measureAt(plane[i]), 1e-13) << input.x << " " << input.y;
    }
  }
  EXPECT_TRUE(fit(graticuleRing(1, 2, 3, 4)).groundPlaces(std::vector<Point>{{0, 0}}).empty());
}

TEST(Fitted, SameFromSeveralThreads) {
  const Ring ring{{450000, 4.6e6}, {550000, 4.6e6}, {550000, 5.1e6}, {450000, 5.1e6}};
  const Projection projection = fit(ring, parseCrs("EPSG:32616"));
  const auto work = [&](std::vector<Point>& out) {
    for (int i = 0; i < 500; ++i) out.push_back(projection.inverse(projection.forward({450000.0 + 100 * i, 5e6})));
  };
  std::vector<std::vector<Point>> results(4);
  {
    std::vector<std::jthread> threads;
    for (auto& result : results) threads.emplace_back([&] { work(result); });
  }
  for (const auto& result : results) EXPECT_EQ(result, results[0]);
}

TEST(ToCrs, ScaleOfMercatorIsTheSecantOfLatitude) {
  const Projection projection = Projection::to(wgs84(), parseCrs("EPSG:3395"));
  for (const double lat : {0.0, 30.0, -60.0}) {
    const Point plane = projection.forward({10, lat});
    const double s = std::sin(lat * M_PI / 180), e2 = 0.00669437999014;
    EXPECT_NEAR(projection.scaleAt(plane), std::sqrt(1 - e2 * s * s) / std::cos(lat * M_PI / 180), 1e-5);
    const Point back = projection.inverse(plane);
    EXPECT_NEAR(back.x, 10, 1e-9);
    EXPECT_NEAR(back.y, lat, 1e-9);
  }
  EXPECT_EQ(projection.description(), "EPSG:3395");
}

TEST(ToCrs, FeetAndDegreesAreUnitsToo) {
  const Projection feet = Projection::to(wgs84(), parseCrs("EPSG:2263"));  // New York, US survey feet
  EXPECT_NEAR(feet.scaleAt(feet.forward({-74, 40.5})), 3937.0 / 1200, 1e-3);
  const Projection degrees = Projection::to(parseCrs("EPSG:32631"), wgs84());
  EXPECT_NEAR(1 / degrees.scaleAt({3, 0}), 110946, 100);  // metres per degree, between longitude and latitude
}

TEST(ToCrs, PointsComeBackToWhereTheyWereInEqualAreaPlanesToo) {
  // Azimuthal, cylindrical and conic; PROJ alone is a tenth of a millimetre off in the first.
  const Crs utm = parseCrs("EPSG:32631");
  for (const char* const plane : {"EPSG:3035", "EPSG:3857", "ESRI:102013", "ESRI:54034"}) {
    SCOPED_TRACE(plane);
    const Projection projection = Projection::to(utm, parseCrs(plane));
    for (const Point& p : {Point{495254.2, 6601757.95}, Point{300000, 4e6}, Point{700000, 7.5e6}}) {
      const Point back = projection.inverse(projection.forward(p));
      EXPECT_LE(std::hypot(back.x - p.x, back.y - p.y), 2e-8);
    }
  }
}

TEST(ToCrs, PlanesGoNowhere) {
  EXPECT_THROW(Projection::to(Crs{}, wgs84()), InputError);
  const Projection plane = Projection::to(wgs84(), Crs{});
  EXPECT_TRUE(plane.isIdentity());
  EXPECT_EQ(plane.forward({3, 4}), (Point{3, 4}));
  EXPECT_EQ(plane.inverse({3, 4}), (Point{3, 4}));
  EXPECT_EQ(plane.scaleAt({3, 4}), 1.0);
}

}  // namespace
}  // namespace coastmesh
