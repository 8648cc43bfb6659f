#include "gis/coast/frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "gis/coast/segment_tags.hpp"
#include "gis/error.hpp"
#include "tests/support/framed_coasts.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

Feature coastFeature(std::vector<Point> line) {
  Feature feature = lineFeature(7, std::move(line));
  feature.from_lines = true;
  return feature;
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

// Mercator's plane ends at 20,037,508 m, and has the land beyond at its other end.
TEST(Frame, BoxesPastTheEdgeOfThePlaneAreWarnedOf) {
  const auto warnings = [](double at, const std::string& crs, const FrameOptions& options) {
    return frame(coastlineOf({polygonFeature(1, square(at, 0, 1e4))}, parseCrs(crs)), options).frame.warnings;
  };
  const std::vector<std::string> past =
      warnings(19.9e6, "EPSG:3857", boxOf(19.8e6, -1e5, 20.3e6, 1e5, DomainSide::Outside));
  ASSERT_EQ(past.size(), 1u);
  EXPECT_NE(past[0].find("it reaches past the edge of EPSG:3857"), std::string::npos) << past[0];
  EXPECT_TRUE(warnings(19.9e6, "EPSG:3857", boxOf(19.8e6, -1e5, 20e6, 1e5, DomainSide::Outside)).empty());
  // Data that go on past the edge themselves, and a plane without such an edge.
  EXPECT_TRUE(warnings(20.1e6, "EPSG:3857", boxOf(19.8e6, -1e5, 20.3e6, 1e5, DomainSide::Outside)).empty());
  EXPECT_TRUE(warnings(-1e4, "EPSG:3413", boxOf(-5e5, -5e5, 5e5, 5e5, DomainSide::Outside)).empty());
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
                .find("the west has to lie below the east; boxes across the antimeridian need an input in longitudes "
                      "and latitudes, and the sides in degrees: reproject it (ogr2ogr -t_srs EPSG:4326)"),
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
  FrameOptions at_sea = boxOf(20, 20, 30, 30);
  at_sea.side = DomainSide::Outside;
  EXPECT_NE(refusalOf(lake, at_sea).find("if all of it is water, mesh a polygon of it instead"), std::string::npos);
}

}  // namespace
}  // namespace coastmesh
