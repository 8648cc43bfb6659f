#include "gis/clean/whole_turns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "gis/coast/turned_rings.hpp"
#include "gis/error.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const FrameOptions kInside{DomainSide::Inside};
bool none(const Point&, const Point&) { return false; }

Ring band(double south, double north, double west = -180) {
  return {{west, south}, {west + 360, south}, {west + 360, north}, {west, north}};
}

Feature regionOf(const Ring& ring) {
  Feature feature = polygonFeature(7, ring);
  feature.use = FeatureUse::Region;
  return feature;
}

// The points of the ring at that latitude.
std::set<double> longitudesAt(const Ring& ring, double latitude) {
  std::set<double> longitudes;
  for (const Point& p : ring)
    if (p.y == latitude) longitudes.insert(p.x);
  return longitudes;
}

TEST(WholeTurns, EdgesOfRegionsGetPointsWhateverTheirDirectionAndRange) {
  for (const double west : {-180.0, 0.0}) {
    Coastline coastline = coastlineOf({regionOf(band(-20, 60, west)), regionOf(band(60, 80, west))}, wgs84());
    std::ranges::reverse(coastline.features[1].polygons[0].outer);
    const FrameReport report = frameWithWholeTurns(coastline, {DomainSide::Globe}, EdgeLine::Plane, none);
    const Ring &south = coastline.features[0].polygons[0].outer, &north = coastline.features[1].polygons[0].outer;
    EXPECT_EQ(south.size(), 37u + 64u);
    EXPECT_EQ(longitudesAt(south, 60), longitudesAt(north, 60));
    EXPECT_EQ(longitudesAt(south, 60).size(), 64u);
    EXPECT_FALSE(longitudesJump(south));
    // Points follow each other along the edges.
    for (std::size_t i = 0; i < south.size(); ++i)
      EXPECT_LE(std::abs(south[i].x - south[(i + 1) % south.size()].x), 10.0 + 1e-9);
    ASSERT_EQ(report.notes.size(), 1u);
    EXPECT_THAT(report.notes[0], HasSubstr("feature 7: its edge from "));
    EXPECT_THAT(report.notes[0], HasSubstr("as 3 other edges do"));
  }
}

TEST(WholeTurns, ALineGetsPointsAndAPoleNone) {
  Feature equator = lineFeature(3, {{-180, 0}, {180, 0}});
  equator.use = FeatureUse::Constraint;
  Coastline coastline = coastlineOf({equator, regionOf(band(-90, -60))}, wgs84());
  frameWithWholeTurns(coastline, {DomainSide::Globe}, EdgeLine::Plane, none);
  EXPECT_EQ(coastline.features[0].lines[0].size(), 37u);
  EXPECT_THAT(longitudesAt(coastline.features[1].polygons[0].outer, -90), ElementsAre(-180, 180));
  EXPECT_EQ(longitudesAt(coastline.features[1].polygons[0].outer, -60).size(), 64u);
}

TEST(WholeTurns, PolygonsOfTheDomainGetPointsIfEdgesAreStraightInDegrees) {
  Coastline coastline =
      coastlineOf({polygonFeature(1, band(80, 85)), polygonFeature(2, {{0, 10}, {9, 10}, {0, 20}})}, wgs84());
  const FrameReport report = frameWithWholeTurns(coastline, kInside, EdgeLine::LonLat, none);
  const Ring& ring = coastline.features[0].polygons[0].outer;
  EXPECT_GT(longitudesAt(ring, 80).size(), 36u);
  EXPECT_GT(longitudesAt(ring, 85).size(), 36u);
  EXPECT_EQ(coastline.features[1].polygons[0].outer.size(), 3u);
  EXPECT_EQ(report.notes.size(), 1u);
}

TEST(WholeTurns, WhatHasNoMeaningIsRefusedWithItsFeatureAndEdge) {
  const auto said = [](const Feature& feature, EdgeLine line) -> std::string {
    Coastline coastline = coastlineOf({feature}, wgs84());
    try {
      frameWithWholeTurns(coastline, kInside, line, none);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const EdgeLine line : {EdgeLine::Plane, EdgeLine::Geodesic})
    EXPECT_THAT(
        said(polygonFeature(4, band(60, 80)), line),
        ::testing::AllOf(HasSubstr("feature 4: its edge from -180, 60 to 180, 60 "), HasSubstr("--edges lonlat")));
  EXPECT_THAT(said(polygonFeature(4, band(-90, -60)), EdgeLine::Plane), HasSubstr("-60 to -180, -60"));
  EXPECT_THAT(said(regionOf(band(60, 80)), EdgeLine::Geodesic), HasSubstr("as a geodesic"));
}

// A continent whose file ends before the pole: as until now, it reaches to the pole.
TEST(WholeTurns, ASingleEdgeClosesAPolygonOverThePoleWithAWarning) {
  const Ring continent{{-180, -85}, {180, -85}, {180, -70}, {60, -68}, {-60, -72}, {-180, -70}};
  Coastline coastline = coastlineOf({polygonFeature(5, continent)}, wgs84());
  const FrameReport report = frameWithWholeTurns(coastline, kInside, EdgeLine::Plane, none);
  EXPECT_EQ(coastline.features[0].polygons[0].outer, continent);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("feature 5: its edge from -180, -85 to 180, -85 "));
  EXPECT_THAT(report.warnings[0], HasSubstr("closed over the pole"));
}

TEST(WholeTurns, OthersStayAsTheyAre) {
  // An island across the antimeridian, whose edges jump, and a box that is less than a turn wide.
  const Ring island{{180, 10}, {-180, 11}, {-179, 12}, {179, 12}, {179, 10}};
  for (const Ring& ring : {island, Ring{{-170, -20}, {0, -20}, {170, -20}, {170, 20}, {0, 20}, {-170, 20}}}) {
    for (const EdgeLine line : {EdgeLine::Plane, EdgeLine::LonLat, EdgeLine::Geodesic}) {
      Coastline coastline = coastlineOf({polygonFeature(1, ring)}, wgs84());
      const FrameReport report = frameWithWholeTurns(coastline, {DomainSide::Globe}, line, none);
      EXPECT_EQ(coastline.features[0].polygons[0].outer, ring);
      EXPECT_THAT(report.notes, IsEmpty());
      EXPECT_THAT(report.warnings, IsEmpty());
    }
  }
  // In the plane of a map, the edge has a length.
  Coastline coastline = coastlineOf({polygonFeature(1, band(-20, 20))}, wgs84());
  const FrameReport report =
      frameWithWholeTurns(coastline, kInside, EdgeLine::Plane, [](const Point&, const Point&) { return true; });
  EXPECT_EQ(coastline.features[0].polygons[0].outer, band(-20, 20));
  EXPECT_THAT(report.warnings, IsEmpty());
}

}  // namespace
}  // namespace coastmesh
