#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>

#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/frame.hpp"
#include "tests/support/framed_coasts.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

double landArea(const Coastline& coastline) {
  const RingArea area(coastline.crs);
  double sum = 0;
  for (const Feature& feature : coastline.features) {
    for (const Polygon& polygon : feature.polygons) sum += area.of(polygon.outer);
  }
  return sum;
}

// The area of the ellipsoid between two parallels, over `width` degrees of longitude.
double zone(double south, double north, double width) {
  const auto below = [](double latitude) {
    const double f = 1 / 298.257223563, e = std::sqrt(f * (2 - f)), s = std::sin(latitude * M_PI / 180);
    return (s / (1 - e * e * s * s) + std::atanh(e * s) / e) / 2;
  };
  const double b = 6378137.0 * (1 - 1 / 298.257223563);
  return b * b * (below(north) - below(south)) * width * M_PI / 180;
}

// Files that are not cut at the antimeridian: islands whose rings jump from one end of the map to the other, and a
// continent around a pole without an edge along it. The area between the ends of a jump, around the globe, is not land.
TEST(Frame, RingsThatJumpHoldNothingBetween) {
  std::vector<Feature> land;
  Ring antarctica;
  for (int lon = -175; lon <= 175; lon += 10) antarctica.push_back({static_cast<double>(lon), -70});
  land.push_back(polygonFeature(1, antarctica));
  land.push_back(polygonFeature(2, square(20, 10, 30)));
  double islands = 0;
  const RingArea area(wgs84());
  // One at each latitude at which the map might be turned away from the land.
  for (int lat = -60; lat < 60; lat += 10) {
    const double south = lat + 0.5, north = lat + 9.5;
    land.push_back(polygonFeature(100 + lat, {{179.5, south}, {-179.5, south}, {-179.5, north}, {179.5, north}}));
    islands += area.of({{179.5, south}, {180.5, south}, {180.5, north}, {179.5, north}});
  }
  const Framed framed = frame(coastlineOf(land, wgs84()), boxOf(-180, -90, 180, 90, DomainSide::Outside));
  ASSERT_EQ(framed.domains.size(), 1u);
  const double globe = GeographicLib::Geodesic::WGS84().EllipsoidArea();
  const double expected = globe - islands - area.of(antarctica) - area.of(square(20, 10, 30));
  EXPECT_NEAR(framed.area() / expected, 1, 1e-4);
}

// An island that its file cuts at the antimeridian, in data from -180 and from 0, and boxes in either range.
TEST(Frame, AcrossTheAntimeridian) {
  const Ring west{{179, -18}, {180, -18}, {180, -17}, {179, -17}},
      east{{-180, -18}, {-179, -18}, {-179, -17}, {-180, -17}};
  Ring east_on = east;
  for (Point& p : east_on) p.x += 360;
  for (const Ring& second : {east, east_on}) {
    const Coastline coastline = coastlineOf({polygonFeature(1, west), polygonFeature(2, second)}, wgs84());
    for (const auto& [from, to] : {std::pair{177.0, -177.0}, {177.0, 183.0}, {-183.0, -177.0}}) {
      const Framed framed = frame(coastline, boxOf(from, -20, to, -15, DomainSide::Outside));
      ASSERT_EQ(framed.domains.size(), 1u);
      const double wanted = zone(-20, -15, 6) - landArea(coastline);
      EXPECT_NEAR(framed.area() / wanted, 1, 2e-6) << from;
    }
  }
}

// Land in data from 0 to 360, and points, lines and regions in either turn, across the antimeridian too.
TEST(Frame, GuestsInAnotherTurn) {
  const auto guest = [](Feature feature, FeatureUse use) {
    feature.use = use;
    return feature;
  };
  const auto turned = [](Feature feature, double degrees) {
    for (Point& p : feature.points) p.x += degrees;
    for (auto& line : feature.lines)
      for (Point& p : line) p.x += degrees;
    for (Polygon& polygon : feature.polygons)
      for (Point& p : polygon.outer) p.x += degrees;
    return feature;
  };
  const Feature land = polygonFeature(1, square(179.4, -18, 1));
  const std::vector<Feature> guests{guest(lineFeature(3, {{178, -16}, {182, -16.5}}), FeatureUse::Weir),
                                    guest(polygonFeature(4, square(179, -19.5, 3)), FeatureUse::Region),
                                    guest(lineFeature(5, {{178, -19}, {179, -19}}), FeatureUse::Constraint)};
  const FrameOptions box = boxOf(177, -20, 183, -15, DomainSide::Outside);
  for (const Feature& one : guests) {
    const Framed expected = frame(coastlineOf({land, one}, wgs84()), box);
    const Framed framed = frame(coastlineOf({land, turned(one, -360)}, wgs84()), box);
    EXPECT_EQ(framed.coastline.features.back().polygons.size(), 1u) << one.fid;
    EXPECT_NEAR(framed.area() / expected.area(), 1, 1e-9) << one.fid;
    EXPECT_NEAR(framed.openLength() / expected.openLength(), 1, 1e-9) << one.fid;
    for (const Domain& domain : framed.domains)
      for (const Point& p : domain.input_points) EXPECT_TRUE(p.x >= 177 && p.x <= 183) << one.fid << " " << p.x;
  }
}

TEST(Frame, PointsInAnotherTurn) {
  Feature points;
  points.use = FeatureUse::Constraint;
  points.points = {{-179.3, -19}, {179.2, -18.5}, {-190, -18}};
  Coastline coastline = coastlineOf({polygonFeature(1, square(179.4, -18, 1)), points}, wgs84());
  frameCoastline(coastline, boxOf(177, -20, 183, -15, DomainSide::Outside));
  EXPECT_EQ(coastline.features[1].points, (std::vector<Point>{{180.7, -19}, {179.2, -18.5}}));
}

// A region across the antimeridian in data from -180 to 180, and an island that reaches past 180: the frame is split
// there, and both sides of the cut are one.
TEST(Frame, WhatReachesPastTheCut) {
  const Feature far = polygonFeature(9, square(20, 0, 1)), east = polygonFeature(2, square(-179.5, -17, 0.3));
  const Feature across = polygonFeature(3, {{179.7, -18.9}, {180.2, -18.6}, {180.1, -18.1}, {179.6, -18.3}});
  const FrameOptions box = boxOf(177, -20, -177, -15, DomainSide::Outside);
  const auto onto360 = [](Feature feature) {
    for (Point& p : feature.polygons[0].outer) p.x += p.x < 0 ? 360 : 0;
    return feature;
  };
  const Framed expected =
      frame(coastlineOf({far, onto360(east), across}, wgs84()), boxOf(177, -20, 183, -15, DomainSide::Outside));
  Feature region = polygonFeature(4, square(178, -17.5, 3));
  region.use = FeatureUse::Region;
  for (const bool with_region : {false, true}) {
    std::vector<Feature> features{far, east, across};
    if (with_region) features.push_back(region);
    const Framed framed = frame(coastlineOf(features, wgs84()), box);
    EXPECT_NEAR(framed.area() / expected.area(), 1, 1e-6) << with_region;
    EXPECT_NEAR(framed.openLength() / expected.openLength(), 1, 1e-6) << with_region;
  }
}

// Boxes round data that run on past 360 begin west of them.
TEST(Frame, RoundDataPastTheEndOfTheLongitudes) {
  for (const double turn : {0.0, -360.0}) {
    const Framed framed = frame(coastlineOf({polygonFeature(1, square(358 + turn, 17, 4))}, wgs84()),
                                boxOf(355 + turn, 16, 365 + turn, 22, DomainSide::Outside));
    EXPECT_EQ(framed.coastline.features.back().polygons.size(), 1u);
    EXPECT_NEAR(framed.area() / (zone(16, 22, 10) - landArea(coastlineOf({framed.coastline.features[0]}, wgs84()))), 1,
                2e-6);
  }
}

// The frame as a feature of its own, like one of --clip, its longitudes from -180 to 180.
Feature frameWithin180(Ring outer, std::vector<Ring> holes = {}) {
  Feature feature = frameFeature(7, std::move(outer));
  feature.polygons[0].holes = std::move(holes);
  const auto moveBack = [](Ring& ring) {
    for (Point& p : ring) p.x -= p.x > 180 ? 360 : 0;
  };
  moveBack(feature.polygons[0].outer);
  std::ranges::for_each(feature.polygons[0].holes, moveBack);
  return feature;
}

// Frames across the antimeridian, in any range of longitudes, around the same island as boxes.
TEST(Frame, PolygonsAcrossTheAntimeridian) {
  const Ring west{{179, -18}, {180, -18}, {180, -17}, {179, -17}},
      east{{-180, -18}, {-179, -18}, {-179, -17}, {-180, -17}};
  const Coastline land = coastlineOf({polygonFeature(1, west), polygonFeature(2, east)}, wgs84());
  const Framed box = frame(land, boxOf(177, -20, -177, -15, DomainSide::Outside));
  for (const Ring& ring :
       {Ring{{177, -20}, {183, -20}, {183, -15}, {177, -15}}, Ring{{-183, -20}, {-177, -20}, {-177, -15}, {-183, -15}},
        Ring{{177, -20}, {-177, -20}, {-177, -15}, {177, -15}}}) {
    Coastline coastline = land;
    coastline.features.push_back(frameFeature(7, ring));
    const Framed framed = frame(coastline, {DomainSide::Outside, {}, {}});
    ASSERT_EQ(framed.domains.size(), 1u);
    EXPECT_NEAR(framed.area() / box.area(), 1, 1e-9) << ring[0].x;
    EXPECT_NEAR(framed.openLength() / box.openLength(), 1, 1e-9) << ring[0].x;
    EXPECT_EQ(framed.frame.notes.size(), ring[1].x - ring[0].x < 0 ? 1u : 0u);
    for (const Polygon& polygon : framed.coastline.features.back().polygons)
      for (const Point& p : polygon.outer) EXPECT_LE(std::abs(p.x), 180);
  }
}

// A frame that crosses the antimeridian several times, with a hole across it, and one that crosses itself: as in data
// from 0 to 360, where nothing is split.
TEST(Frame, PolygonsThatCrossTheAntimeridianRepeatedly) {
  const Ring comb{{175, 0}, {185, 0}, {185, 2}, {178, 2}, {178, 4}, {184, 4.5}, {184, 8}, {175, 9}};
  const std::vector<Ring> holes{{{179, 5}, {181, 5.2}, {181, 7}, {179, 7}}, {{180.5, 1}, {181, 1}, {181, 1.5}}};
  const Ring crossed{{176, 0}, {184, 8}, {184, 0}, {176, 7}};
  const Feature islet = polygonFeature(1, square(176.2, 1.2, 0.1)), far = polygonFeature(2, square(20, 0, 1));
  const Feature far_east = polygonFeature(2, square(200, 0, 1));
  for (const auto& [ring, inner] : {std::pair{comb, holes}, {crossed, {}}}) {
    Feature on = frameFeature(7, ring);
    on.polygons[0].holes = inner;
    const Framed expected = frame(coastlineOf({islet, far_east, on}, wgs84()), {DomainSide::Outside, {}, {}});
    const Framed framed =
        frame(coastlineOf({islet, far, frameWithin180(ring, inner)}, wgs84()), {DomainSide::Outside, {}, {}});
    EXPECT_EQ(expected.frame.notes.size(), 0u);
    EXPECT_EQ(framed.frame.notes.size(), 1u);
    EXPECT_EQ(framed.domains.size(), expected.domains.size());
    EXPECT_NEAR(framed.area() / expected.area(), 1, 1e-6);
    EXPECT_NEAR(framed.openLength() / expected.openLength(), 1, 1e-6);
  }
}

// A frame round a pole that its file does not close there, from any starting point.
TEST(Frame, APolygonRoundAPole) {
  Ring ring;
  for (int lon = -170; lon <= 170; lon += 20) ring.push_back({static_cast<double>(lon), -60});
  const Coastline land = coastlineOf({polygonFeature(1, square(20, -75, 3))}, wgs84());
  for (const std::size_t first : {0u, 5u, 9u}) {
    std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(first));
    Coastline coastline = land;
    coastline.features.push_back(frameFeature(7, ring));
    const Framed framed = frame(coastline, {DomainSide::Outside, {}, {}});
    ASSERT_EQ(framed.domains.size(), 1u);
    EXPECT_NEAR(framed.area() / (zone(-90, -60, 360) - landArea(land)), 1, 1e-5) << first;
  }
}

// With many points, so that edges are the same lines in every projection.
Ring along(const Ring& ring) {
  Ring fine;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    for (int k = 0; k < 400; ++k) fine.push_back({a.x + (b.x - a.x) * k / 400, a.y + (b.y - a.y) * k / 400});
  }
  return fine;
}

// Land whose ring jumps at the antimeridian and extends far beyond the box. It covers what the same land cut there
// covers, in boxes on either side of the map and across its end, and nothing else at the latitudes where it jumps.
TEST(Frame, LandThatJumpsIsCutOffLikeAnyOther) {
  Ring jumping = along({{100, 55}, {190, 62}, {188, 70}, {150, 68}, {100, 75}});
  for (Point& p : jumping) p.x -= p.x > 180 ? 360 : 0;
  const Coastline whole = coastlineOf({polygonFeature(1, jumping)}, wgs84());
  const Coastline cut = coastlineOf(
      {polygonFeature(1, along({{100, 55}, {180, 55 + 7 * 8.0 / 9}, {180, 68 + 2 * 30.0 / 38}, {150, 68}, {100, 75}})),
       polygonFeature(2, along({{-180, 55 + 7 * 8.0 / 9}, {-170, 62}, {-172, 70}, {-180, 68 + 2 * 30.0 / 38}}))},
      wgs84());
  for (const Box& box : {Box{0, 60, 50, 72}, Box{-60, 56, -20, 74}, Box{160, 58, -160, 72}, Box{-178, 58, -150, 71},
                         Box{140, 50, 175, 69}, Box{-180, 60, 180, 80}}) {
    const FrameOptions options = boxOf(box.xmin, box.ymin, box.xmax, box.ymax, DomainSide::Outside);
    Coastline with_islet = whole, cut_with_islet = cut;  // so that every box contains some land
    const Feature islet = polygonFeature(9, square(box.xmin + 0.5, box.ymax - 0.2, 0.1));
    with_islet.features.push_back(islet);
    cut_with_islet.features.push_back(islet);
    const Framed framed = frame(with_islet, options), expected = frame(cut_with_islet, options);
    EXPECT_NEAR(framed.area() / expected.area(), 1, 1e-5) << box.xmin;
    EXPECT_NEAR(framed.openLength() / expected.openLength(), 1, 1e-3) << box.xmin;
    EXPECT_EQ(framed.domains.size(), expected.domains.size()) << box.xmin;
  }
}

// Land is cut off along a parallel far beyond the frame; the cut leaves no straight edge in the plane.
TEST(Frame, WhatIsCutOffStaysBeyondTheFrame) {
  const Coastline coastline = coastlineOf(
      {polygonFeature(1, {{0, 30}, {120, 30}, {120, 61}, {0, 61}}), polygonFeature(2, square(-100, 70, 1))}, wgs84());
  const Framed framed = frame(coastline, boxOf(-180, 65, 180, 90, DomainSide::Outside));
  const Framed islet = frame(coastlineOf({polygonFeature(2, square(-100, 70, 1))}, wgs84()),
                             boxOf(-180, 65, 180, 90, DomainSide::Outside));
  ASSERT_EQ(framed.domains.size(), 1u);
  EXPECT_NEAR(framed.area() / islet.area(), 1, 1e-9);
  EXPECT_NEAR(framed.openLength() / islet.openLength(), 1, 1e-9);
  // The same if the land extends into the frame.
  const Coastline large = coastlineOf({polygonFeature(1, along({{0, 30}, {120, 30}, {120, 70}, {0, 70}}))}, wgs84());
  const Framed sea = frame(large, boxOf(-180, 65, 180, 80, DomainSide::Outside));
  EXPECT_NEAR(sea.area() / (zone(65, 80, 360) - zone(65, 70, 120)), 1, 1e-4);
}

// Only where the working plane may bend them: pieces of 15 km, whatever the unit.
TEST(Frame, LongEdgesAreDividedUnlessCoordinatesAreThePlane) {
  const auto cornersOf = [](const Crs& crs, double side, bool in_plane) {
    Coastline coastline = coastlineOf({polygonFeature(1, square(0.4 * side, 0.4 * side, 0.2 * side))}, crs);
    FrameOptions options = boxOf(0, 0, side, side, DomainSide::Outside);
    options.in_plane = in_plane;
    frameCoastline(coastline, options);
    return coastline.features.back().polygons.at(0).outer.size();
  };
  EXPECT_EQ(cornersOf({}, 2e6, false), 4u);
  EXPECT_EQ(cornersOf(wgs84(), 30, true), 4u);
  EXPECT_GT(cornersOf(wgs84(), 30, false), 4u * 150);
  EXPECT_EQ(cornersOf(parseCrs("EPSG:32616"), 150'000, false), 4u * 10);
  EXPECT_EQ(cornersOf(parseCrs("EPSG:32616"), 150'000, true), 4u);
  EXPECT_EQ(cornersOf(parseCrs("EPSG:2263"), 150'000 / 0.3048, false), 4u * 11);  // US survey feet, a bit more
}

TEST(Frame, PolygonsThatAreNoDegreesAreRefused) {
  Coastline coastline = coastlineOf({polygonFeature(1, square(1, 1, 2))}, wgs84());
  coastline.features.push_back(polygonFeature(0, square(0, 0, 22'600'000)));
  coastline.features.back().use = FeatureUse::Frame;
  EXPECT_NE(refusalOf(coastline, {}).find("give its CRS"), std::string::npos);
}

// Around a pole, and the whole globe: of the frame's boundary, only the parts in water remain.
TEST(Frame, RoundThePoleAndTheGlobe) {
  const Ring antarctica{{-180, -90}, {-180, -78}, {-90, -72}, {0, -70}, {90, -66}, {180, -78}, {180, -90}};
  Ring fine;  // long edges on the ellipsoid differ from those in the plane
  for (std::size_t i = 0; i < antarctica.size(); ++i) {
    const Point &a = antarctica[i], &b = antarctica[(i + 1) % antarctica.size()];
    const int n = a.y == -90 || b.y == -90 ? 1 : 400;
    for (int k = 0; k < n; ++k) fine.push_back({a.x + (b.x - a.x) * k / n, a.y + (b.y - a.y) * k / n});
  }
  const Coastline coastline = coastlineOf({polygonFeature(1, fine)}, wgs84());
  const Framed ring = frame(coastline, boxOf(-180, -90, 180, -60, DomainSide::Outside));
  ASSERT_EQ(ring.domains.size(), 1u);
  // The boundary runs along the parallel in straight pieces of 0.3 degrees.
  EXPECT_NEAR(ring.area() / (zone(-90, -60, 360) - landArea(coastline)), 1, 1e-5);
  const Framed globe = frame(coastline, boxOf(-180, -90, 180, 90, DomainSide::Outside));
  ASSERT_EQ(globe.domains.size(), 1u);
  EXPECT_NEAR(globe.area() / (zone(-90, 90, 360) - landArea(coastline)), 1, 2e-6);
  EXPECT_EQ(globe.openLength(), 0);
}

}  // namespace
}  // namespace coastmesh
