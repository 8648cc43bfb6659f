#include "gis/coast/frame.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>

#include "gis/clean/clean.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/group_features.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/error.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {
namespace {

struct Framed {
  Coastline coastline;
  std::vector<Domain> domains;
  CleanReport report;
  FrameReport frame;

  double area() const {
    double sum = 0;
    for (const Domain& domain : domains) sum += geodesicArea(domain, coastline.crs);
    return sum;
  }
  double openLength() const {
    double sum = 0;
    for (const Domain& domain : domains) {
      for (const Segment& s : domain.pslg.segments) {
        const Point &a = domain.pslg.points[s.a], &b = domain.pslg.points[s.b];
        if (s.tag == kOpenTag) sum += std::hypot(b.x - a.x, b.y - a.y);
      }
    }
    return sum;
  }
};

Framed frame(Coastline coastline, const FrameOptions& options, const CleanOptions& cleaning = {.snap_m = 0.0}) {
  Framed result;
  result.frame = frameCoastline(coastline, options);
  result.coastline = std::move(coastline);
  for (const auto& members : groupFeatures(result.coastline)) {
    const Projection projection = Projection::fitted(result.coastline, members);
    try {
      result.domains.push_back(cleanFeatures(result.coastline, members, projection, cleaning, result.report));
      EXPECT_EQ(defectOfLabelled(result.domains.back().pslg), "");
    } catch (const NothingWanted&) {
    }
  }
  return result;
}

FrameOptions boxOf(double west, double south, double east, double north, DomainSide side = DomainSide::Auto) {
  FrameOptions options;
  options.side = side;
  options.box = Box{west, south, east, north};
  return options;
}

Feature coastFeature(std::vector<Point> line) {
  Feature feature = lineFeature(7, std::move(line));
  feature.from_lines = true;
  return feature;
}

std::string refusalOf(Coastline coastline, const FrameOptions& options) {
  try {
    frame(std::move(coastline), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Frame, WaterRoundAnIsland) {
  const Framed framed =
      frame(coastlineOf({polygonFeature(1, square(2, 2, 3))}), boxOf(0, 0, 10, 10, DomainSide::Outside));
  ASSERT_EQ(framed.domains.size(), 1u);
  EXPECT_DOUBLE_EQ(framed.area(), 100 - 9);
  EXPECT_DOUBLE_EQ(framed.openLength(), 40);
}

// Two overlapping lands, one of them across the frame's boundary, and a third beyond the frame.
TEST(Frame, LandAcrossTheBoundary) {
  const Coastline coastline = coastlineOf(
      {polygonFeature(1, square(-5, 2, 8)), polygonFeature(2, square(2, 3, 3)), polygonFeature(3, square(30, 30, 1))});
  const Framed framed = frame(coastline, boxOf(0, 0, 10, 10, DomainSide::Outside));
  EXPECT_DOUBLE_EQ(framed.area(), 100 - 3 * 8 - 2 * 3);
  EXPECT_DOUBLE_EQ(framed.openLength(), 40 - 8 - 3);
  EXPECT_EQ(framed.frame.beyond_frame, 1u);
}

// The frame cuts the features, but only some of their islands, whose full area is unknown.
TEST(Frame, SmallIslandsOfFeaturesThatItCutsAreFilled) {
  const CleanOptions least{.snap_m = 0.0, .min_island_area_m2 = 5.0};
  const Ring whole = square(2, 2, 1), large = square(5, 5, 3), cut = square(11, 1, 2);
  const FrameOptions box = boxOf(0, 0, 10, 10);
  const Framed sea = frame(coastlineOf({polygonFeature(1, square(-5, -5, 30), {whole, large, cut})}), box, least);
  EXPECT_EQ(sea.coastline.features[0].polygons.front().cut, (std::vector<bool>{true, false, false, true}));
  EXPECT_DOUBLE_EQ(sea.area(), 100 - 9);
  EXPECT_EQ(sea.report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], 1u);
  Feature land = polygonFeature(1, whole);
  for (const Ring& ring : {large, square(-5, 3, 6), square(9.5, 1, 2)}) land.polygons.push_back({ring, {}});
  const Framed water = frame(coastlineOf({land}), boxOf(0, 0, 10, 10, DomainSide::Outside), least);
  EXPECT_DOUBLE_EQ(water.area(), 100 - 9 - 6 - 1);
  EXPECT_EQ(water.report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], 1u);
}

// Lakes within, across and beyond the frame, and one around all of it.
TEST(Frame, InsideOfPolygons) {
  const Coastline coastline = coastlineOf({polygonFeature(1, square(1, 1, 2)), polygonFeature(2, square(8, 8, 4)),
                                           polygonFeature(3, square(20, 0, 2)), polygonFeature(4, square(10.5, 1, 1))});
  const Framed framed = frame(coastline, boxOf(0, 0, 10, 10));
  EXPECT_EQ(framed.domains.size(), 2u);
  EXPECT_DOUBLE_EQ(framed.area(), 4 + 4);
  EXPECT_DOUBLE_EQ(framed.openLength(), 4);
  EXPECT_DOUBLE_EQ(frame(coastlineOf({polygonFeature(1, square(-50, -50, 100))}), boxOf(0, 0, 10, 10)).area(), 100);
}

Feature frameFeature(std::int64_t fid, Ring ring) {
  Feature feature = polygonFeature(fid, std::move(ring));
  feature.use = FeatureUse::Frame;
  return feature;
}

// Frames that overlap, touch along a side, or lie apart: their sides inside the water are not edges.
TEST(Frame, SeveralAreOne) {
  const Framed framed = frame(coastlineOf({polygonFeature(1, square(2, 2, 3)), frameFeature(11, square(0, 0, 10)),
                                           frameFeature(12, square(8, 4, 10)), frameFeature(13, square(-10, 0, 10)),
                                           frameFeature(14, square(40, 0, 1)), frameFeature(15, square(-30, 0, 5))}),
                              {DomainSide::Outside, {}, {}});
  EXPECT_NEAR(framed.area(), 100 - 9 + 100 - 2 * 6 + 100 + 1 + 25, 1e-9);
  EXPECT_NEAR(framed.openLength(), 40 + 40 - 2 * (2 + 6) + 40 - 2 * 10 + 4 + 20, 1e-9);
  for (const Domain& domain : framed.domains)
    for (const Segment& s : domain.pslg.segments) EXPECT_TRUE(s.left < 0 || s.right < 0);
  EXPECT_EQ(std::ranges::count(framed.coastline.features, FeatureUse::Frame, &Feature::use), 3);
}

// A frame that fills the hole of another, and a self-crossing frame that meets another.
TEST(Frame, SeveralWithHolesAndCrossings) {
  Feature with_hole = frameFeature(11, square(0, 0, 10));
  with_hole.polygons[0].holes.push_back(square(4, 4, 2));
  const Coastline filled =
      coastlineOf({polygonFeature(1, square(1, 1, 2)), with_hole, frameFeature(12, square(4, 4, 2))});
  const Framed whole = frame(filled, {DomainSide::Outside, {}, {}});
  EXPECT_NEAR(whole.area(), 100 - 4, 1e-9);
  for (const Segment& s : whole.domains.at(0).pslg.segments) EXPECT_TRUE(s.left < 0 || s.right < 0);
  const Coastline crossing =
      coastlineOf({polygonFeature(1, square(1, 4, 2)), frameFeature(11, {{0, 0}, {10, 10}, {10, 0}, {0, 10}}),
                   frameFeature(12, {{10, 0}, {20, 0}, {20, 10}, {10, 10}})});
  EXPECT_NEAR(frame(crossing, {DomainSide::Outside, {}, {}}).area(), 50 - 4 + 100, 1e-9);
}

TEST(Frame, WaterLiesToTheRightOfACoast) {
  const std::vector<Point> north{{4, -3}, {4, 5}, {3, 13}}, south(north.rbegin(), north.rend());
  const double east = 10 * 10 - (4 * 5 + (4 + 3.375) / 2 * 5);  // the line crosses y = 10 at x = 3.375
  const Framed right = frame(coastlineOf({coastFeature(north)}), boxOf(0, 0, 10, 10));
  EXPECT_NEAR(right.area(), east, 1e-9);
  EXPECT_EQ(right.report.notes.size(), 1u);
  EXPECT_NEAR(frame(coastlineOf({coastFeature(south)}), boxOf(0, 0, 10, 10)).area(), 100 - east, 1e-9);
  FrameOptions options = boxOf(0, 0, 10, 10);
  options.water_at = Point{1, 1};
  EXPECT_NEAR(frame(coastlineOf({coastFeature(north)}), options).area(), 100 - east, 1e-9);
}

// The outside of polygons is water, whichever way their rings run, also in the presence of lines.
TEST(Frame, OutsideOfPolygonsIsWaterAmongLinesToo) {
  Ring land = square(0.4, 0.4, 0.2), lake = square(0.51, 0.51, 0.05);
  const Feature line = coastFeature({{0.3, 0.5}, {0.5, 0.5}});
  for (const bool turned : {false, true}) {
    if (turned) std::ranges::reverse(land);
    const Framed alone = frame(coastlineOf({polygonFeature(1, land)}), boxOf(0, 0, 1, 1, DomainSide::Outside));
    const Framed sea = frame(coastlineOf({polygonFeature(1, land), line}), boxOf(0, 0, 1, 1, DomainSide::Outside));
    EXPECT_NEAR(sea.area(), alone.area(), 1e-9 * alone.area());
    const Framed lakes =
        frame(coastlineOf({polygonFeature(1, land, {lake}), line}), boxOf(0, 0, 1, 1, DomainSide::Outside));
    EXPECT_GT(lakes.area(), alone.area() * (1.0 + 0.9 * 0.05 * 0.05));
    std::ranges::reverse(lake);
  }
}

TEST(Frame, TwoSeasOfOneRule) {
  const std::vector<Point> west{{3, -1}, {3, 11}}, east{{6, 11}, {6, -1}};
  const Framed framed = frame(coastlineOf({coastFeature(west), coastFeature(east)}), boxOf(0, 0, 10, 10));
  EXPECT_DOUBLE_EQ(framed.area(), 30);  // the strait between them
  const std::vector<Point> west_down(west.rbegin(), west.rend()), east_up(east.rbegin(), east.rend());
  EXPECT_DOUBLE_EQ(frame(coastlineOf({coastFeature(west_down), coastFeature(east_up)}), boxOf(0, 0, 10, 10)).area(),
                   70);
  EXPECT_NE(refusalOf(coastlineOf({coastFeature(west), coastFeature(east_up)}), boxOf(0, 0, 10, 10)).find("--water-at"),
            std::string::npos);
}

// Parts of the frame without a coast, or without a connection to the place of the water, are named.
TEST(Frame, PartsThatAreNotMeshedAreNamed) {
  const Feature coast = coastFeature({{4, -1}, {4, 11}}), next = coastFeature({{34, -1}, {34, 11}});
  const Coastline bare = coastlineOf({coast, frameFeature(11, square(0, 0, 10)), frameFeature(12, square(30, 0, 10)),
                                      frameFeature(13, square(60, 2, 2))});
  const Framed by_rule = frame(bare, {});
  EXPECT_DOUBLE_EQ(by_rule.area(), 60);
  ASSERT_EQ(by_rule.report.warnings.size(), 1u);
  EXPECT_NE(
      by_rule.report.warnings[0].find("2 parts of the frame, around (35, 5) and (61, 3), are without a coastline"),
      std::string::npos)
      << by_rule.report.warnings[0];
  FrameOptions options;
  options.water_at = Point{5, 5};
  const Framed by_place = frame(
      coastlineOf({coast, next, frameFeature(11, square(0, 0, 10)), frameFeature(12, square(30, 0, 10))}), options);
  EXPECT_DOUBLE_EQ(by_place.area(), 60);
  ASSERT_EQ(by_place.report.warnings.size(), 1u);
  EXPECT_NE(by_place.report.warnings[0].find("1 part of the frame, around (35, 5), is not connected"),
            std::string::npos)
      << by_place.report.warnings[0];
  // Without a frame, only the water at the place is asked for.
  const Framed rings = frame(coastlineOf({coastFeature({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}}),
                                          coastFeature({{20, 0}, {29, 0}, {29, 9}, {20, 9}, {20, 0}})}),
                             options);
  EXPECT_TRUE(rings.report.warnings.empty());
}

TEST(Frame, AGapInTheCoastIsRefusedByItsPlace) {
  const Coastline coastline = coastlineOf({coastFeature({{4, -1}, {4, 5}}), coastFeature({{4, 5.25}, {4, 11}})});
  const std::string text = refusalOf(coastline, boxOf(0, 0, 10, 10));
  EXPECT_NE(text.find("feature 7: the coastline ends at 4, 5"), std::string::npos) << text;
  EXPECT_NE(text.find("0.25 m away"), std::string::npos) << text;
}

// A pier has a free end, but begins at a coast.
TEST(Frame, APierBecomesAnEdge) {
  const Coastline coastline = coastlineOf({coastFeature({{4, -1}, {4, 5}, {4, 11}}), coastFeature({{4, 5}, {6, 5}})});
  const Framed framed = frame(coastline, boxOf(0, 0, 10, 10));
  EXPECT_DOUBLE_EQ(framed.area(), 60);
  const auto& segments = framed.domains[0].pslg.segments;
  EXPECT_EQ(std::ranges::count_if(segments, [](const Segment& s) { return isLineTag(s.tag); }), 1);
}

TEST(Frame, OnlyRingsOfLines) {
  Feature island = polygonFeature(1, square(2, 2, 3));
  island.from_lines = true;
  EXPECT_DOUBLE_EQ(frame(coastlineOf({island}), boxOf(0, 0, 10, 10)).area(), 91);
  EXPECT_DOUBLE_EQ(frame(coastlineOf({island}), boxOf(0, 0, 10, 10, DomainSide::Inside)).area(), 9);
}

TEST(Frame, TheWaterOfAPlaceWithoutAFrame) {
  FrameOptions options;
  options.water_at = Point{1.5, 1.5};
  const Coastline coastline =
      coastlineOf({polygonFeature(1, square(0, 0, 4), {square(1, 1, 1)}), polygonFeature(2, square(9, 9, 1))});
  EXPECT_DOUBLE_EQ(frame(coastline, options).area(), 1);
  options.water_at = Point{0.5, 0.5};
  EXPECT_DOUBLE_EQ(frame(coastline, options).area(), 15);
}

TEST(Frame, OddBoxesAreRefused) {
  const Coastline lake = coastlineOf({polygonFeature(1, square(1, 1, 2))}, wgs84());
  EXPECT_THROW(frame(lake, boxOf(0, 10, 10, 0)), OptionError);
  EXPECT_THROW(frame(lake, boxOf(10, 0, 10, 10)), OptionError);
  EXPECT_NE(refusalOf(lake, boxOf(-200, 0, 200, 10)).find("at most 360 degrees"), std::string::npos);
  // An east a full turn or more west of the west.
  for (const auto& [west, east] : {std::pair{180.0, -180.0}, {200.0, -200.0}, {0.0, -360.0}})
    EXPECT_THROW(frame(lake, boxOf(west, -60, east, 60)), OptionError) << west;
  const Coastline in_plane = coastlineOf({polygonFeature(1, square(1, 1, 2))});
  EXPECT_NE(refusalOf(in_plane, boxOf(10, 0, 0, 10))
                .find("the west has to lie below the east; boxes across the antimeridian need an input in longitudes"),
            std::string::npos);
  EXPECT_NE(refusalOf(lake, boxOf(0, 0, 10, 100)).find("degrees"), std::string::npos);
  EXPECT_NE(refusalOf(lake, boxOf(20, 20, 30, 30)).find("nothing of the input lies in it"), std::string::npos);
  Coastline clipped = lake;
  clipped.features.push_back(frameFeature(9, square(20, 20, 1)));
  const std::string beyond = refusalOf(clipped, {});
  EXPECT_NE(beyond.find("nothing of the input lies in it, which reaches over 20,20,21,21"), std::string::npos)
      << beyond;
  EXPECT_EQ(beyond.find("--bbox"), std::string::npos) << beyond;
  FrameOptions outside;
  outside.side = DomainSide::Outside;
  EXPECT_NE(refusalOf(lake, outside).find("--bbox"), std::string::npos);
}

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

// A lake in three pieces: the cuts disappear, and so do the vertices that they left in the shore.
TEST(Dissolve, LeavesNoTraceOfACut) {
  const Coastline coastline = coastlineOf({polygonFeature(4, {{0, 0}, {5, 0}, {5, 5}, {0, 5}}),
                                           polygonFeature(2, {{5, 0}, {9, 0}, {9, 5}, {5, 5}}),
                                           polygonFeature(3, {{9, 0}, {12, 1}, {12, 5}, {9, 5}})});
  CleanOptions options;
  options.dissolve = true;
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), options, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  // The corners, and the vertex at (9, 0), where the shore turns.
  EXPECT_EQ(domain.pslg.points.size(), 5u);
  EXPECT_DOUBLE_EQ(labelledArea(domain.pslg, 0), 60 - 1.5);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::DissolvedEdge)], 2u + 3u);
}

// If a feature holds the rest, as on a whole globe, shores separate the lakes from that as well: only the cut
// disappears.
TEST(Dissolve, LeavesTheShoreTowardsTheRest) {
  Coastline coastline = coastlineOf({polygonFeature(1, {{0, 0}, {5, 0}, {5, 5}, {0, 5}}), Feature{},
                                     polygonFeature(2, {{5, 0}, {9, 0}, {9, 4}, {5, 5}}),
                                     polygonFeature(3, {{20, 1}, {24, 1}, {22, 3}})});
  coastline.rest = 1;
  CleanOptions options;
  options.dissolve = true;
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), options, report);
  // The cut and its end at (5, 0); at (5, 5) the shore turns.
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::DissolvedEdge)], 1u + 1u);
  EXPECT_EQ(domain.pslg.segments.size(), 5u + 3u);
  EXPECT_EQ(domain.rest, 1);
  for (const Segment& s : domain.pslg.segments) {
    const RegionId lake = domain.pslg.points[s.a].x < 15.0 ? 0 : 3;
    EXPECT_EQ(std::minmax(s.left, s.right), std::minmax(RegionId{1}, lake));
  }
}

// A bend no larger than the decimals of the input is a trace of the cut. A bend is real if it has more digits, even if
// it is smaller, or if the lake itself is as small as the decimals.
TEST(Dissolve, TakesABendForATraceOnlyWithinTheDecimals) {
  const auto vertices = [](double unit, double x, double bend) {
    const Coastline coastline =
        coastlineOf({polygonFeature(1, {{0, 0}, {x, bend}, {x, 3 * unit}, {0, 3 * unit}}),
                     polygonFeature(2, {{x, bend}, {7 * unit, 0}, {7 * unit, 3 * unit}, {x, 3 * unit}})});
    CleanOptions options;
    options.dissolve = true;
    CleanReport report;
    const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), options, report);
    EXPECT_NEAR(labelledArea(domain.pslg, 0), 21 * unit * unit - 3.5 * unit * bend * (domain.pslg.points.size() == 5),
                1e-12 * unit * unit);
    return domain.pslg.points.size();
  };
  EXPECT_EQ(vertices(100, 312.34, 0.01), 4u);
  EXPECT_EQ(vertices(1000, 4000, 0), 4u);
  EXPECT_EQ(vertices(100, 312.3456789, 0.0000001), 4u);
  EXPECT_EQ(vertices(100, 312.3456789, 0.00001), 5u);
  EXPECT_EQ(vertices(100, 300 + 1 / 7.0, 0.01), 5u);
  EXPECT_EQ(vertices(0.01, 0.03, 0.01), 5u);
}

// The number of segments that belong to lines of `use`.
std::ptrdiff_t segmentsOf(const Domain& domain, FeatureUse use) {
  return std::ranges::count_if(domain.pslg.segments, [&](const Segment& s) {
    return isLineTag(s.tag) && domain.lines.at(lineOfTag(s.tag)).use == use;
  });
}

// Where lines overlap, a weir takes precedence over a constraint, and a constraint over a region's border.
TEST(Constraints, OverlappingLines) {
  Feature wall = lineFeature(1, {{1, 5}, {9, 5}}), weir = lineFeature(2, {{3, 5}, {5, 5}});
  wall.use = FeatureUse::Constraint;
  weir.use = FeatureUse::Weir;
  Feature region = polygonFeature(3, square(4, 5, 4));
  region.use = FeatureUse::Region;
  const Coastline coastline = coastlineOf({polygonFeature(0, square(0, 0, 10)), wall, weir, region});
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), {0.0}, report);
  const auto lengthOf = [&](FeatureUse use, bool border) {
    double sum = 0;
    for (const Segment& s : domain.pslg.segments) {
      if (!isLineTag(s.tag)) continue;
      const DomainLine& line = domain.lines.at(lineOfTag(s.tag));
      const Point &a = domain.pslg.points[s.a], &b = domain.pslg.points[s.b];
      if (line.use == use && line.borders_region == border) sum += std::hypot(b.x - a.x, b.y - a.y);
    }
    return sum;
  };
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Weir, false), 1);
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Weir, true), 1);
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Constraint, false), 3);
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Constraint, true), 3);
  EXPECT_DOUBLE_EQ(lengthOf(FeatureUse::Region, true), 12);
}

TEST(Constraints, LinesPointsAndRegionsInTheWater) {
  Feature wall = lineFeature(1, {{1, 1}, {3, 1}, {30, 1}}), weir = lineFeature(2, {{1, 2}, {3, 2}});
  wall.use = FeatureUse::Constraint;
  wall.points = {{50, 50}, {5, 5}, {5, 5}};  // the first is outside, and repeats are ignored
  wall.attributes = {{"Name", "wall"}};
  weir.use = FeatureUse::Weir;
  Feature region = polygonFeature(3, square(6, 6, 20));
  region.use = FeatureUse::Region;
  const Coastline coastline = coastlineOf({polygonFeature(0, square(0, 0, 10)), wall, weir, region});
  CleanReport report;
  const auto groups = groupFeatures(coastline);
  ASSERT_EQ(groups.size(), 1u);
  const Domain domain = cleanFeatures(coastline, groups[0], Projection::plane(), {0.0}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "vertex in no segment at 5, 5");  // requested points
  EXPECT_EQ(segmentsOf(domain, FeatureUse::Weir), 1);
  EXPECT_EQ(segmentsOf(domain, FeatureUse::Constraint), 2);
  EXPECT_EQ(segmentsOf(domain, FeatureUse::Region), 2);
  ASSERT_EQ(domain.lines.size(), 3u);
  EXPECT_EQ(domain.lines[0].name, "wall");
  EXPECT_EQ(domain.lines[1].name, "");
  EXPECT_EQ(domain.lines[2].name, "3");  // the region's number, as it has no name
  EXPECT_EQ(std::ranges::count(domain.pslg.points, Point{5, 5}), 1);
  EXPECT_EQ(std::ranges::count(domain.pslg.points, Point{50, 50}), 0);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::OutsideWater)], 1u);
  EXPECT_DOUBLE_EQ(labelledArea(domain.pslg, 0), 100);
}

}  // namespace
}  // namespace coastmesh
