#include "gis/clean/clean.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "gis/clean/areas_within.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/error.hpp"
#include "tests/support/cleaned.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {
namespace {

TEST(Clean, KeepsAValidPolygonAsItIs) {
  const Ring outer = square(0, 0, 10), hole = square(2, 2, 3);
  for (const bool reversed : {false, true}) {
    Ring given = outer;
    if (reversed) std::reverse(given.begin(), given.end());
    const Cleaned cleaned = cleanInPlane({polygonFeature(7, given, {hole})});
    EXPECT_EQ(cleaned.edits(), 0u);
    Ring expected = given;
    expected.insert(expected.end(), hole.begin(), hole.end());
    EXPECT_EQ(cleaned.domain.pslg.points, expected);
    EXPECT_EQ(cleaned.domain.input_points, expected);
    EXPECT_EQ(cleaned.segments(), 8u);
    EXPECT_EQ(cleaned.area(0), 91.0);
  }
}

TEST(Clean, DropsRepeatedPoints) {
  const Cleaned cleaned =
      cleanInPlane({polygonFeature(1, {{0, 0}, {0, 0}, {4, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}})});
  EXPECT_EQ(cleaned.count(EditKind::RepeatedPoint), 4u);
  EXPECT_EQ(cleaned.edits(), 4u);
  EXPECT_EQ(cleaned.points(), 4u);
  EXPECT_EQ(cleaned.area(0), 16.0);
}

TEST(Clean, SnapsPointsNearerThanTheSnapDistanceToTheFirst) {
  const Ring ring{{0, 0}, {4, 0}, {4, 0.05}, {4, 4}, {0, 4}, {-0.05, 0.05}};
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, ring)}, {.snap_m = 0.1});
  EXPECT_EQ(cleaned.count(EditKind::RepeatedPoint), 2u);
  EXPECT_EQ(cleaned.domain.input_points, (Ring{{0, 0}, {4, 0}, {4, 4}, {0, 4}}));
  EXPECT_EQ(cleanInPlane({polygonFeature(1, ring)}, {.snap_m = 0.01}).points(), 6u);
}

TEST(Clean, SnapsEdgesToPointsNearerThanTheSnapDistance) {
  // An island's corner comes within 0.05 of the shore.
  const Ring island{{5, 0.05}, {6, 2}, {4, 2}};
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 10), {island})}, {.snap_m = 0.1});
  EXPECT_EQ(cleaned.count(EditKind::OverlappingEdge), 1u);
  EXPECT_EQ(cleaned.count(EditKind::TouchingRing), 1u);
  EXPECT_EQ(cleaned.segments(), 8u);
}

// The shore comes closer to the second island once it is led through a corner of the first.
TEST(Clean, AnEdgeThatWasLedThroughAPointIsSnappedToOthersAgain) {
  const Ring shore{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Ring first{{5, 0.9}, {5, 4}, {2, 4}}, second{{7.5, 1.4}, {8.8, 6}, {6, 6}};
  const Cleaned alone = cleanInPlane({polygonFeature(1, shore, {second})}, {.snap_m = 1.0});
  EXPECT_EQ(alone.count(EditKind::OverlappingEdge), 0u);
  EXPECT_EQ(alone.segments(), 4u + 3u);
  const Cleaned both = cleanInPlane({polygonFeature(1, shore, {first, second})}, {.snap_m = 1.0});
  EXPECT_EQ(both.segments(), 6u + 3u + 3u);
  // Minus the islands and the area below the shore, which is led through both.
  EXPECT_NEAR(both.area(0), 100.0 - 4.65 - 6.44 - 0.5 * (5.0 * 0.9 + 2.5 * (0.9 + 1.4) + 2.5 * 1.4), 1e-9);
}

TEST(Clean, DropsSpikes) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, {{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {0, 4}})});
  EXPECT_EQ(cleaned.count(EditKind::Spike), 1u);
  EXPECT_EQ(cleaned.report.edits.front().place, (Point{9, 0}));
  EXPECT_EQ(cleaned.domain.input_points, square(0, 0, 4));
  // At the start of the ring, and at its end.
  EXPECT_EQ(cleanInPlane({polygonFeature(1, {{9, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}})}).count(EditKind::Spike),
            1u);
  EXPECT_EQ(cleanInPlane({polygonFeature(1, {{4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {9, 0}})}).count(EditKind::Spike),
            1u);
}

TEST(Clean, ASpikeAlongItsOwnShoreVanishes) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, {{0, 0}, {4, 0}, {4, 6}, {4, 4}, {0, 4}})});
  EXPECT_EQ(cleaned.area(0), 16.0);
  EXPECT_EQ(cleaned.points(), 4u);
  EXPECT_GT(cleaned.count(EditKind::OverlappingEdge), 0u);
}

TEST(Clean, MakesTwoLobesOfABowTie) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(3, {{0, 0}, {4, 4}, {4, 0}, {0, 4}})});
  EXPECT_EQ(cleaned.count(EditKind::SelfCrossing), 1u);
  EXPECT_EQ(cleaned.edits(), 1u);
  EXPECT_EQ(cleaned.report.edits.front().place, (Point{2, 2}));
  EXPECT_EQ(cleaned.report.edits.front().fid, 3);
  EXPECT_EQ(cleaned.points(), 5u);
  EXPECT_EQ(cleaned.domain.input_points.back(), (Point{2, 2}));
  EXPECT_EQ(cleaned.area(0), 8.0);
}

TEST(Clean, IslandsMayTouchTheShoreAndEachOther) {
  const Ring outer = square(0, 0, 10);
  // One corner on the shore's corner.
  Cleaned cleaned = cleanInPlane({polygonFeature(1, outer, {{{0, 0}, {3, 1}, {1, 3}}})});
  EXPECT_EQ(cleaned.count(EditKind::TouchingRing), 1u);
  EXPECT_EQ(cleaned.edits(), 1u);
  EXPECT_EQ(cleaned.area(0), 96.0);
  // Two corners on the shore's edges cut the lake in two.
  cleaned = cleanInPlane({polygonFeature(1, outer, {{{5, 0}, {6, 5}, {5, 10}, {4, 5}}})});
  EXPECT_EQ(cleaned.count(EditKind::TouchingRing), 2u);
  EXPECT_EQ(cleaned.count(EditKind::OverlappingEdge), 2u);
  EXPECT_EQ(cleaned.area(0), 90.0);
  // Two islands share a corner.
  cleaned = cleanInPlane({polygonFeature(1, outer, {square(2, 2, 2), square(4, 4, 2)})});
  EXPECT_EQ(cleaned.count(EditKind::TouchingRing), 1u);
  EXPECT_EQ(cleaned.area(0), 92.0);
  // Two islands share an edge: they become one.
  cleaned = cleanInPlane({polygonFeature(1, outer, {square(2, 2, 2), square(4, 2, 2)})});
  EXPECT_EQ(cleaned.count(EditKind::OverlappingEdge), 1u);
  EXPECT_EQ(cleaned.area(0), 92.0);
  EXPECT_EQ(cleaned.segments(), 10u);
  // An island with an edge on the shore is a bay.
  cleaned = cleanInPlane({polygonFeature(1, outer, {square(2, 0, 2)})});
  EXPECT_EQ(cleaned.area(0), 96.0);
  EXPECT_EQ(cleaned.segments(), 8u);
}

TEST(Clean, TheFirstOfTwoEqualFeaturesWins) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 4)), polygonFeature(2, square(0, 0, 4))});
  EXPECT_EQ(cleaned.area(0), 16.0);
  EXPECT_EQ(cleaned.area(1), 0.0);
  EXPECT_EQ(cleaned.count(EditKind::FeaturesOverlap), 1u);
  EXPECT_EQ(cleaned.report.edits.front().fid, 2);
  EXPECT_EQ(cleaned.segments(), 4u);
}

TEST(Clean, FeaturesThatCrossAreParted) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 4)), polygonFeature(2, square(2, 2, 4))});
  EXPECT_EQ(cleaned.count(EditKind::FeaturesCross), 2u);
  EXPECT_EQ(cleaned.count(EditKind::FeaturesOverlap), 1u);
  EXPECT_EQ(cleaned.area(0), 16.0);
  EXPECT_EQ(cleaned.area(1), 12.0);
}

TEST(Clean, FeaturesThatShareAShoreNeedNoEdit) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 4)), polygonFeature(2, square(4, 0, 4))});
  EXPECT_EQ(cleaned.edits(), 0u);
  EXPECT_EQ(cleaned.segments(), 7u);
  EXPECT_EQ(cleaned.area(0), 16.0);
  EXPECT_EQ(cleaned.area(1), 16.0);
}

TEST(Clean, AFeatureInAnotherIsSwallowed) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 9)), polygonFeature(2, square(2, 2, 2))});
  EXPECT_EQ(cleaned.count(EditKind::FeaturesOverlap), 1u);
  EXPECT_EQ(cleaned.points(), 4u);
  EXPECT_EQ(cleaned.area(0), 81.0);
}

// In any order: the inner feature does not become an island of the outer one.
TEST(Clean, AFeatureInAnotherIsWarnedOf) {
  const Feature lake = polygonFeature(1, square(0, 0, 9)), island = polygonFeature(2, square(2, 2, 2)),
                beside = polygonFeature(3, square(9, 0, 9)), across = polygonFeature(4, square(8, 8, 4));
  for (const auto& features : {std::vector{lake, island, beside}, {island, lake, across}}) {
    const Cleaned cleaned = cleanInPlane(features);
    ASSERT_EQ(cleaned.report.warnings.size(), 1u);
    EXPECT_NE(cleaned.report.warnings[0].find("feature 2 lies in "), std::string::npos) << cleaned.report.warnings[0];
    EXPECT_NE(cleaned.report.warnings[0].find("feature 1 at "), std::string::npos) << cleaned.report.warnings[0];
  }
  EXPECT_EQ(cleanInPlane({lake, island, lake}).report.warnings.size(), 1u);
  EXPECT_NE(cleanInPlane({lake, island, lake}).report.warnings.at(0).find("and so do 1 more"), std::string::npos);
  EXPECT_TRUE(cleanInPlane({lake, beside, across}).report.warnings.empty());
}

TEST(Clean, LinesThatCloseNoRingSayHowFarTheyAreApart) {
  Feature lines;
  lines.source = "coast";
  lines.lines = {{{0, 0}, {4, 0}, {4, 4}}, {{4, 4.5}, {0, 4}, {0, 0}}};
  try {
    cleanInPlane({lines});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the nearest ends, 4, 4 and 4, 4.5, are 0.5 apart"), std::string::npos)
        << error.what();
  }
}

// In a plane that is not true to scale, the gap is that on the ground.
TEST(Clean, LinesThatCloseNoRingSayHowFarTheyAreApartOnTheGround) {
  Feature lines;
  lines.lines = {{{10, 60}, {10.5, 60}, {10.5, 60.3}, {10, 60.3}, {10, 60.015}}};
  const Coastline coastline = coastlineOf({lines}, wgs84());
  for (const char* const code : {"EPSG:3857", "EPSG:2263"}) {  // Mercator, and feet
    CleanReport report;
    try {
      cleanFeatures(coastline, {0}, Projection::to(wgs84(), parseCrs(code)), {}, report);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("60.015, are 167"), std::string::npos) << error.what();
    }
  }
}

// Otherwise the even-odd rule would cancel both.
TEST(Clean, RingsThatAFeatureHasTwiceCountOnce) {
  const Ring island = square(1, 1, 2), turned{{3, 3}, {1, 3}, {1, 1}, {3, 1}}, reversed{{3, 1}, {1, 1}, {1, 3}, {3, 3}};
  Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 4), {island, turned, reversed})});
  EXPECT_EQ(cleaned.count(EditKind::RepeatedRing), 2u);
  EXPECT_EQ(cleaned.edits(), 2u);
  EXPECT_EQ(cleaned.area(0), 12.0);
  Feature twice = polygonFeature(1, square(0, 0, 4));
  twice.polygons.push_back(twice.polygons.front());
  cleaned = cleanInPlane({twice});
  EXPECT_EQ(cleaned.count(EditKind::RepeatedRing), 1u);
  EXPECT_EQ(cleaned.area(0), 16.0);
  // A ring traced twice in one pass, and one that touches itself at its start.
  cleaned = cleanInPlane({polygonFeature(1, {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}})});
  EXPECT_EQ(cleaned.count(EditKind::RepeatedRing), 1u);
  EXPECT_EQ(cleaned.area(0), 16.0);
  cleaned = cleanInPlane({polygonFeature(1, {{0, 0}, {4, 0}, {4, 4}, {0, 0}, {-4, 0}, {-4, -4}})});
  EXPECT_EQ(cleaned.count(EditKind::RepeatedRing), 0u);
  EXPECT_EQ(cleaned.area(0), 16.0);
  // Two islands that share a corner; the second is listed twice.
  const Ring west{{2, 2}, {1, 3}, {1, 1}}, east{{2, 2}, {3, 1}, {3, 3}};
  cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 4), {west, east, east})});
  EXPECT_EQ(cleaned.count(EditKind::RepeatedRing), 1u);
  EXPECT_EQ(cleaned.area(0), 14.0);
  // An island that another part fills is not a repeated ring.
  Feature filled = polygonFeature(1, square(0, 0, 4), {island});
  filled.polygons.push_back({island, {}});
  cleaned = cleanInPlane({filled});
  EXPECT_EQ(cleaned.count(EditKind::RepeatedRing), 0u);
  EXPECT_EQ(cleaned.area(0), 16.0);
}

TEST(Clean, MisplacedRingsGoByTheEvenOddRule) {
  Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 4), {square(6, 0, 2)})});
  EXPECT_EQ(cleaned.count(EditKind::MisplacedRing), 1u);
  EXPECT_EQ(cleaned.area(0), 20.0);
  Feature nested = polygonFeature(1, square(0, 0, 9));
  nested.polygons.push_back({square(3, 3, 3), {}});
  cleaned = cleanInPlane({nested});
  EXPECT_EQ(cleaned.count(EditKind::MisplacedRing), 1u);
  EXPECT_EQ(cleaned.area(0), 72.0);
}

TEST(Clean, DropsRingsWithoutArea) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(
      1, square(0, 0, 4), {{{1, 1}}, {{1, 1}, {2, 2}}, {{1, 1}, {2, 2}, {1, 1}, {2, 2}}, {{1, 1}, {1, 1}, {1, 1}}})});
  EXPECT_EQ(cleaned.count(EditKind::DegenerateRing), 4u);
  EXPECT_EQ(cleaned.area(0), 16.0);
  EXPECT_EQ(cleaned.points(), 4u);
  // Three collinear points: detected by the arrangement.
  EXPECT_EQ(cleanInPlane({polygonFeature(1, square(0, 0, 4), {{{1, 1}, {2, 2}, {3, 3}}})}).points(), 4u);
}

TEST(Clean, FillsSmallIslands) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 9), {square(1, 1, 1), square(3, 3, 2)})},
                                       {.snap_m = 0, .min_island_area_m2 = 2.0});
  EXPECT_EQ(cleaned.count(EditKind::SmallIsland), 1u);
  EXPECT_EQ(cleaned.area(0), 77.0);
}

TEST(Clean, FillsPondsOfSmallIslands) {
  Feature nested = polygonFeature(1, square(0, 0, 20), {square(2, 2, 3), square(10, 10, 4)});
  nested.polygons.push_back({square(2, 3, 1), {}});    // touches the shore of its island
  nested.polygons.push_back({square(11, 11, 1), {}});  // on a larger island
  nested.polygons.push_back({square(30, 30, 1), {}});  // elsewhere
  const Cleaned cleaned = cleanInPlane({nested}, {.snap_m = 0, .min_island_area_m2 = 10.0});
  EXPECT_EQ(cleaned.count(EditKind::SmallIsland), 1u);
  EXPECT_EQ(cleaned.count(EditKind::MisplacedRing), 0u);
  EXPECT_EQ(cleaned.area(0), 400.0 - 16.0 + 1.0 + 1.0);
}

TEST(Clean, HolesWithAnotherAreaAreNoSmallIslands) {
  const Feature around = polygonFeature(1, square(0, 0, 20), {square(2, 2, 3), square(10, 10, 4), square(16, 2, 1)});
  const Feature lake = polygonFeature(2, square(3, 3, 1));       // on the first
  const Feature country = polygonFeature(3, square(10, 10, 4));  // fills the second
  const Feature beside = polygonFeature(4, square(21, 0, 2));
  const CleanOptions least{.snap_m = 0, .min_island_area_m2 = 50.0};
  const Coastline coastline = coastlineOf({around, lake, country, beside});
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0, 2}, Projection::plane(), least, report);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], 1u);
  EXPECT_EQ(geodesicArea(domain, coastline.crs), 400.0 - 9.0);
  EXPECT_EQ(geodesicArea(coastline, {1}), 1.0);
  // Both countries have their own area.
  const Cleaned cleaned = cleanInPlane({around, country}, least);
  EXPECT_EQ(cleaned.area(0), 400.0 - 16.0);
  EXPECT_EQ(cleaned.area(1), 16.0);
  // At any turn of longitudes.
  Coastline at_180 = coastlineOf({polygonFeature(1, square(170, 0, 20), {{{178, 5}, {-178, 5}, {-178, 9}, {178, 9}}}),
                                  polygonFeature(2, square(-179.5, 6, 1))},
                                 wgs84());
  const AreasWithin areas(at_180);
  EXPECT_TRUE(areas.any(at_180, at_180.features[0].polygons[0].holes[0], 0));
  EXPECT_FALSE(areas.any(at_180, at_180.features[0].polygons[0].holes[0], 1));
}

// Countries, and islands that a data set cuts at tiles.
TEST(Clean, PolygonsOfLandThatShareEdgesAreOneIsland) {
  const auto land = [](std::int64_t fid, std::vector<Ring> rings) {
    Feature feature;
    feature.fid = fid;
    feature.use = FeatureUse::Land;
    for (Ring& ring : rings) feature.polygons.push_back({std::move(ring), {}});
    return feature;
  };
  Feature frame = polygonFeature(1, square(0, 0, 40));
  frame.use = FeatureUse::Frame;
  const Feature large = land(2, {{{5, 5}, {10, 5}, {10, 10}, {6, 10}, {5, 10}}, square(5, 10, 1)});
  const Feature west = land(3, {square(20, 5, 2)}), east = land(4, {square(22, 5, 2)});    // 8 together
  const Feature islets = land(5, {square(30, 5, 1), square(31, 5, 1), square(35, 5, 1)});  // 2 together, and 1
  const Cleaned cleaned = cleanInPlane({frame, large, west, east, islets}, {.snap_m = 0, .min_island_area_m2 = 7.0});
  EXPECT_EQ(cleaned.count(EditKind::SmallIsland), 3u);
  EXPECT_EQ(cleaned.area(0), 1600.0 - 26 - 8);
}

// An inner sea as lines, with the water to their right, in land beside an ocean; and a sea round a place that is said
// to be in the water, whatever the directions.
TEST(Clean, FillsSmallIslandsOfInnerSeas) {
  const auto coast = [](std::int64_t fid, Ring outer, std::vector<Ring> holes, bool clockwise) {
    Feature feature = polygonFeature(fid, std::move(outer), std::move(holes));
    feature.use = FeatureUse::Coast;
    if (clockwise) {
      std::ranges::reverse(feature.polygons[0].outer);
    } else {
      for (Ring& hole : feature.polygons[0].holes) std::ranges::reverse(hole);
    }
    return feature;
  };
  const CleanOptions least{.snap_m = 0, .min_island_area_m2 = 3.0};
  Feature frame = polygonFeature(1, square(0, 0, 40));
  frame.use = FeatureUse::Frame;
  const std::vector<Ring> small_and_large{square(22, 2, 1), square(26, 2, 2)};
  const Feature land = coast(2, {{10, -1}, {41, -1}, {41, 41}, {10, 41}}, {}, false);
  const Feature sea = coast(3, square(20, 1, 10), small_and_large, true);
  const Feature island = coast(4, square(2, 2, 6), {square(4, 4, 1)}, false),
                islet = coast(5, square(2, 20, 1), {}, false);
  Cleaned cleaned = cleanInPlane({frame, land, sea, island, islet}, least);
  EXPECT_EQ(cleaned.count(EditKind::SmallIsland), 2u);
  EXPECT_EQ(cleaned.area(0), 400.0 - 36 + 1 + 100 - 4);

  for (const bool clockwise : {false, true}) {
    for (const auto& [place, area, islands] :
         {std::tuple{Point{29, 9}, 100.0 - 4, 2u}, std::tuple{Point{22.5, 2.5}, 1.0 + 4, 1u}}) {
      Coastline coastline = coastlineOf(
          {coast(3, square(20, 1, 10), small_and_large, clockwise), coast(5, square(26.5, 2.5, 1), {}, clockwise)});
      coastline.water_at = place;
      CleanReport report;
      const Domain domain = cleanFeatures(coastline, {0, 1}, Projection::plane(), least, report);
      EXPECT_EQ(geodesicArea(domain, coastline.crs), area) << place.x;
      EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SmallIsland)], islands) << place.x;
    }
  }
  // A lake smaller than the bound is no island.
  Coastline lake = coastlineOf({coast(3, square(20, 1, 1), {}, false)});
  lake.water_at = Point{20.5, 1.5};
  CleanReport report;
  EXPECT_EQ(geodesicArea(cleanFeatures(lake, {0}, Projection::plane(), least, report), lake.crs), 1.0);
}

TEST(Clean, KeepsOpenLinesInside) {
  // A wharf from the shore, a breakwater inside, a line outside, one that crosses the shore.
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 10)), lineFeature(2, {{0, 5}, {3, 5}}),
                                        lineFeature(3, {{5, 5}, {6, 6}, {7, 5}}), lineFeature(4, {{20, 0}, {30, 0}}),
                                        lineFeature(5, {{8, 8}, {12, 8}})});
  const auto& segments = cleaned.domain.pslg.segments;
  EXPECT_EQ(std::count_if(segments.begin(), segments.end(), [](auto& s) { return s.left == 0 && s.right == 0; }), 4);
  EXPECT_EQ(cleaned.segments(), 4u + 2u + 4u);
  EXPECT_EQ(cleaned.count(EditKind::FeaturesCross), 1u);
  EXPECT_EQ(cleaned.area(0), 100.0);
}

TEST(Clean, ALineAlongTheShoreChangesNothing) {
  const Cleaned cleaned = cleanInPlane({polygonFeature(1, square(0, 0, 4)), lineFeature(2, {{1, 0}, {3, 0}})});
  EXPECT_EQ(cleaned.area(0), 16.0);
  EXPECT_EQ(cleaned.segments(), 6u);
}

TEST(Clean, FarFromTheOriginAndVerySmall) {
  for (const double offset : {0.0, 1e7, -1e7}) {
    const double side = offset == 0 ? 1e-9 : 1e-3;
    Ring bow_tie{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    for (Point& p : bow_tie) p = {offset + p.x * side, offset + p.y * side};
    const Cleaned cleaned = cleanInPlane({polygonFeature(1, bow_tie)});
    EXPECT_EQ(cleaned.points(), 5u);
    EXPECT_NEAR(cleaned.area(0) / (side * side), 0.5, 1e-5);
  }
}

TEST(Clean, RefusesWhatEnclosesNoArea) {
  EXPECT_THROW(cleanInPlane({polygonFeature(1, {{0, 0}, {1, 0}, {2, 0}})}), InputError);
  EXPECT_THROW(cleanInPlane({polygonFeature(1, {{0, 0}, {1, 0}})}), InputError);
  EXPECT_THROW(cleanInPlane({lineFeature(1, {{0, 0}, {1, 0}, {1, 1}})}), InputError);
  EXPECT_THROW(cleanInPlane({polygonFeature(1, {})}), InputError);
}

TEST(Clean, RefusesAPointThatIsNoPlaceByNameAndPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  try {
    cleanInPlane({polygonFeature(12, {{0, 0}, {1, 0}, {nan, 5}})});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("feature 12"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("nan, 5"), std::string::npos);
  }
}

TEST(Clean, EditsLieInTheInputsCoordinates) {
  const Coastline coastline = coastlineOf({polygonFeature(1, {{-87, 45}, {-86, 46}, {-86, 45}, {-87, 46}})}, wgs84());
  CleanReport report;
  const Projection projection = Projection::fitted(coastline, {0});
  const Domain domain = cleanFeatures(coastline, {0}, projection, {}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  ASSERT_EQ(report.edits.size(), 1u);
  EXPECT_NEAR(report.edits[0].place.x, -86.5, 1e-9);
  EXPECT_NEAR(report.edits[0].place.y, 45.5, 1e-2);
  ASSERT_EQ(domain.input_points.size(), 5u);
  EXPECT_EQ(domain.input_points[1], (Point{-86, 46}));
  const Point back = projection.forward(domain.input_points[4]);
  EXPECT_NEAR(back.x, domain.pslg.points[4].x, 1e-4);
  EXPECT_NEAR(back.y, domain.pslg.points[4].y, 1e-4);
}

TEST(Clean, WhatTouchesInTheInputTouchesInThePlane) {
  // Two lakes divided along a parallel. The southern one has an additional vertex on the cut, which is off the northern
  // one's straight edge after projection.
  const Coastline coastline = coastlineOf({polygonFeature(1, {{0, 50}, {2, 50}, {2, 51}, {0, 51}}),
                                           polygonFeature(2, {{0, 49}, {2, 49}, {2, 50}, {1, 50}, {0, 50}})},
                                          wgs84());
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0, 1}, Projection::fitted(coastline, {0, 1}), {}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  EXPECT_EQ(domain.pslg.points.size(), 7u);
  EXPECT_EQ(domain.pslg.segments.size(), 8u);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::FeaturesOverlap)], 0u);
}

TEST(Clean, HealsTheCutAlongTheAntimeridian) {
  // An island state in two halves; the eastern half has a vertex on the cut that the western half lacks.
  Feature feature = polygonFeature(1, {{179, -17}, {180, -17}, {180, -16}, {179, -16}});
  feature.polygons.push_back({{{-180, -17}, {-179, -17}, {-179, -16}, {-180, -16}, {-180, -16.4}}, {}});
  const Coastline coastline = coastlineOf({feature}, wgs84());
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0}, Projection::fitted(coastline, {0}), {}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  EXPECT_EQ(domain.pslg.points.size(), 6u);
  EXPECT_EQ(domain.pslg.segments.size(), 6u);
  EXPECT_NEAR(labelledArea(domain.pslg, 0) / geodesicArea(coastline, {0}), 1.0, 1e-3);
}

TEST(Clean, HealsEdgesAlongTheAntimeridianThatJump) {
  // The western half runs along the cut past the end of the eastern half and back, to a point with the longitude of the
  // other side: a spike, which only shows once that edge has the vertices of the cut.
  Feature feature =
      polygonFeature(1, {{-180, -17.4}, {180, -17.5}, {177, -17.6}, {177, -16.4}, {180, -16.5}, {180, -16.49}});
  feature.polygons.push_back({{{-180, -17.5}, {-179, -17.6}, {-179, -16.4}, {-180, -16.5}}, {}});
  const Coastline coastline = coastlineOf({feature}, wgs84());
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0}, Projection::fitted(coastline, {0}), {}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  EXPECT_EQ(domain.pslg.points.size(), 6u);
  EXPECT_EQ(domain.pslg.segments.size(), 6u);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::Spike)], 1u);
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SelfCrossing)], 0u);
  EXPECT_NEAR(labelledArea(domain.pslg, 0) / geodesicArea(coastline, {0}), 1.0, 1e-3);
}

TEST(Clean, AnOceanRoundThePoleNeedsNoCut) {
  // Water from 60°N to the pole in plate carrée: a rectangle of longitudes whose upper side is the pole.
  Ring ring;
  for (int lon = -180; lon <= 180; lon += 10) ring.push_back({static_cast<double>(lon), 60});
  ring.push_back({180, 90});
  ring.push_back({-180, 90});
  const Coastline coastline = coastlineOf({polygonFeature(1, ring)}, wgs84());
  CleanReport report;
  const Projection projection = Projection::fitted(coastline, {0});
  EXPECT_NE(projection.description().find("polar stereographic"), std::string::npos);
  const Domain domain = cleanFeatures(coastline, {0}, projection, {}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  EXPECT_EQ(domain.pslg.points.size(), 36u);
  EXPECT_EQ(domain.pslg.segments.size(), 36u);
}

TEST(Clean, ReportsEveryKindByAName) {
  std::vector<std::string> names;
  for (std::size_t kind = 0; kind < kEditKinds; ++kind) names.emplace_back(toString(static_cast<EditKind>(kind)));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_NE(names.front(), "");
}

}  // namespace
}  // namespace coastmesh
