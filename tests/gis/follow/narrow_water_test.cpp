#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

// A sea of side 100 with inlets in its western side, 30 deep: pairs of the width of the land before an inlet and of the
// inlet, from north to south.
Domain combedSea(const std::vector<std::pair<double, double>>& inlets) {
  std::vector<Point> ring{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  double y = 95.0;
  for (const auto& [land, water] : inlets) {
    y -= land;
    for (const Point& p : {Point{0, y}, Point{-30, y}, Point{-30, y - water}, Point{0, y - water}}) ring.push_back(p);
    y -= water;
  }
  Domain domain;
  addShore(domain, ring);
  return domain;
}

TEST(FollowSizes, TheWaterKeepsItsAreaWhereNarrowWaterIsClosed) {
  const Domain sea = combedSea({{15.0, 2.5}, {15.0, 2.5}});
  const double area = areaOf(sea);
  ASSERT_GT(2 * 2.5 * 30.0, 0.014 * area);  // closing the inlets takes this area
  CleanReport report;
  const Domain coarse = followSizes(Domain(sea), ConstantSize(4.0), {}, oneFeature(), report);
  EXPECT_GE(countOf(report, EditKind::ClosedWater), 2u);
  EXPECT_NEAR(areaOf(coarse), area, 0.007 * area);
  for (const Point& p : coarse.pslg.points) {
    double least = 1e300;
    for (const Segment& s : sea.pslg.segments)
      least = std::min(least, squaredDistanceToSegment(p, sea.pslg.points[s.a], sea.pslg.points[s.b]));
    EXPECT_LE(std::sqrt(least), 0.4 + 1e-9);  // a tenth of the size
  }
}

TEST(FollowSizes, WhereLandAndWaterAreNarrowNeitherGivesWayToAllOfTheOther) {
  std::vector<std::pair<double, double>> inlets;
  for (int i = 0; i < 12; ++i) inlets.emplace_back(2.1 + 0.15 * ((5 * i) % 12), 2.5 + 0.1 * ((7 * i) % 12));
  Domain sea = combedSea(inlets);
  const double area = areaOf(sea);
  CleanReport report;
  const Domain coarse = followSizes(std::move(sea), ConstantSize(4.0), {}, oneFeature(), report);
  EXPECT_NEAR(areaOf(coarse), area, 0.01 * area);
  EXPECT_GE(leastApart(coarse), 0.45 * 4.0);
  EXPECT_GT(countOf(report, EditKind::ClosedWater), 0u);
  EXPECT_GT(countOf(report, EditKind::DroppedSpit), 0u);
}

// A bay behind a bar, with one narrow mouth, a quarter of an element deep: simplifying alone may get stuck in its
// shore.
TEST(FollowSizes, AShallowBayWithAWindingShoreIsNotLeftToSimplifying) {
  std::vector<Point> ring{{0, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 50.3}, {-1, 50.3}, {-1, 55}};
  // Thin spikes of land from the west, almost to the bar.
  for (double y = 55.0; y > 45.5; y -= 0.8)
    for (const Point& p :
         {Point{-5, y}, Point{-5, y - 0.5}, Point{-1.5, y - 0.5}, Point{-1.5, y - 0.6}, Point{-5, y - 0.6}})
      ring.push_back(p);
  ring.insert(ring.end(), {{-5, 45}, {-1, 45}, {-1, 50}, {0, 50}});
  Domain domain;
  addShore(domain, ring);
  constexpr double kSize = 20.0;
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(kSize), {}, oneFeature(), report);
  EXPECT_GE(countOf(report, EditKind::DroppedSpit) + countOf(report, EditKind::ClosedWater), 10u);
  for (const Segment& s : coarse.pslg.segments)
    EXPECT_GE(distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]), 0.45 * kSize);
  EXPECT_NEAR(areaOf(coarse), 1e4, 100.0);
}

TEST(FollowSizes, AChannelNarrowerThanAnElementIsClosed) {
  const ConstantSize size(2.0);
  CleanReport wide, narrow, kept;
  EXPECT_EQ(parts(followSizes(twoLakes(3.0), size, {}, oneFeature(), wide)), 1u);
  EXPECT_EQ(countOf(wide, EditKind::ClosedWater), 0u);
  EXPECT_EQ(parts(followSizes(twoLakes(0.6), size, {.strait_min = 0.4}, oneFeature(), narrow)), 2u);
  EXPECT_GE(countOf(narrow, EditKind::ClosedWater), 1u);
  const Domain open = followSizes(twoLakes(0.6), size, {.channel_min = 0.0}, oneFeature(), kept);
  EXPECT_EQ(parts(open), 1u);
  EXPECT_GE(leastApart(open), 0.6 - 1e-9);
  const FollowOptions wider{.channel_min = 2.0, .strait_min = 1.6};
  EXPECT_EQ(parts(followSizes(twoLakes(3.0), size, wider, oneFeature(), kept)), 2u);
}

TEST(FollowSizes, AStraitALittleNarrowerThanAnElementThatAloneJoinsWatersIsWidened) {
  for (const double width : {0.9, 1.5}) {
    for (const double channel_min : {1.0, 1.5}) {
      const Domain before = twoLakes(width);
      const double area = areaOf(before);
      CleanReport report;
      const FollowOptions options{.channel_min = channel_min, .strait_min = 0.4};
      const Domain coarse = followSizes(Domain(before), ConstantSize(2.0), options, oneFeature(), report);
      EXPECT_EQ(parts(coarse), 1u);
      EXPECT_GE(countOf(report, EditKind::WidenedPassage), 1u);
      EXPECT_EQ(countOf(report, EditKind::CutOffWater), 0u);
      EXPECT_NEAR(areaOf(coarse), area, 0.01 * area + 20.0 * channel_min - 10.0 * width);
      EXPECT_GE(leastApart(coarse), 0.75 * 2.0);
      addWaterNotes(report, options);
      ASSERT_EQ(report.notes.size(), 1u);
      double x = 0.0, y = 0.0, wide = 0.0, length = 0.0, behind = 0.0;
      ASSERT_EQ(
          std::sscanf(report.notes[0].c_str(),
                      "straits that are the only connection between waters were widened to an element "
                      "instead of closed, for the largest of 1 water: (%lf, %lf), %lf wide, about %lf long, to %lf",
                      &x, &y, &wide, &length, &behind),
          5)
          << report.notes[0];
      EXPECT_NEAR(x, 25.0, 6.0);
      EXPECT_NEAR(y, 10.0, 1.0);
      EXPECT_NEAR(wide, width, 0.4);
      EXPECT_NEAR(behind, 400.0, 20.0);
    }
  }
  CleanReport closed;
  EXPECT_EQ(parts(followSizes(twoLakes(1.5), ConstantSize(2.0), {.strait_min = 1.0}, oneFeature(), closed)), 2u);
}

// A pond of side 6 behind a strait 15 long; widening the strait would take more than a quarter of the pond's area.
TEST(FollowSizes, NoStraitIsWidenedThatTakesAsMuchAsTheWaterBehindItHas) {
  Domain domain;
  addShore(domain, {{0, 0},
                    {20, 0},
                    {20, 9.5},
                    {35, 9.5},
                    {35, 7},
                    {41, 7},
                    {41, 13},
                    {35, 13},
                    {35, 10.5},
                    {20, 10.5},
                    {20, 20},
                    {0, 20}});
  CleanReport report;
  followSizes(std::move(domain), ConstantSize(2.0), {.keep = KeepWater::Largest}, oneFeature(), report);
  EXPECT_EQ(countOf(report, EditKind::WidenedPassage), 0u);
  EXPECT_EQ(countOf(report, EditKind::CutOffWater), 1u);
}

// Two lakes behind a sea, one behind the other.
TEST(FollowSizes, WatersBehindOneAnotherAreAllJoined) {
  Domain domain;
  addShore(domain,
           {{0, 0},   {20, 0},  {20, 9.3},  {24, 9.3},  {24, 0},  {36, 0},  {36, 9.3},  {40, 9.3},  {40, 0},  {52, 0},
            {52, 20}, {40, 20}, {40, 10.7}, {36, 10.7}, {36, 20}, {24, 20}, {24, 10.7}, {20, 10.7}, {20, 20}, {0, 20}});
  CleanReport report;
  EXPECT_EQ(
      parts(followSizes(std::move(domain), ConstantSize(2.0), {.keep = KeepWater::Largest}, oneFeature(), report)), 1u);
  EXPECT_EQ(countOf(report, EditKind::CutOffWater), 0u);
}

TEST(FollowSizes, ASpitNarrowerThanAnElementGoesAndABarThatPartsWatersStays) {
  const std::vector<Point> spit{{0, 0}, {19.5, 0}, {19.5, 12}, {20.5, 12}, {20.5, 0}, {40, 0}, {40, 20}, {0, 20}};
  const ConstantSize size(2.0);
  for (const double least : {1.0, 0.0}) {
    Domain domain;
    addShore(domain, spit);
    CleanReport report;
    const Domain coarse = followSizes(std::move(domain), size, {.land_min = least}, oneFeature(), report);
    EXPECT_EQ(countOf(report, EditKind::DroppedSpit), least > 0.0 ? 1u : 0u);
    EXPECT_EQ(std::ranges::any_of(coarse.pslg.points,
                                  [](const Point& p) { return p.x > 15 && p.x < 25 && p.y > 5 && p.y < 15; }),
              least == 0.0);
    EXPECT_NEAR(areaOf(coarse), 788.0, 8.0);
  }
  Domain barred;
  addShore(barred, {{0, 0}, {19.5, 0}, {19.5, 20}, {0, 20}});
  addShore(barred, {{20.5, 0}, {40, 0}, {40, 20}, {20.5, 20}});
  CleanReport report;
  EXPECT_EQ(parts(followSizes(std::move(barred), size, {}, oneFeature(), report)), 2u);
}

// Two waters with an opening in the wall between them. Sizes grow from the shores; sizes of the triangles at the
// opening's mouths, which extend far into the water, must not count.
TEST(FollowSizes, AnOpeningIsWidenedByTheSizesInIt) {
  for (const double width : {0.35, 0.45, 0.6, 0.8}) {
    for (const double thick : {0.2, 3.0}) {
      const double w = 0.5 * width, t = 0.5 * thick;
      const SizeOf size(1.0, 3.0,
                        [&](const Point& p) { return std::min(3.0, 1.0 + 0.1 * std::max(0.0, std::abs(p.y) - t)); });
      Domain domain;
      addShore(domain, {{-30, -30},
                        {30, -30},
                        {30, -t},
                        {w, -t},
                        {w, t},
                        {30, t},
                        {30, 30},
                        {-30, 30},
                        {-30, t},
                        {-w, t},
                        {-w, -t},
                        {-30, -t}});
      CleanReport report;
      const FollowOptions options{.land_min = 0.0};
      const Domain coarse = followSizes(std::move(domain), size, options, oneFeature(), report);
      EXPECT_EQ(parts(coarse), width < options.strait_min ? 2u : 1u) << width << " " << thick;
    }
  }
}

// A harbour behind a breakwater much thinner than an element: 15 out into the sea, and 10 along the coast.
TEST(FollowSizes, LongBreakwatersThatGoAreNamed) {
  const auto harbour = [](double out, double along) {
    Domain domain;
    addShore(domain, {{-30, 0},
                      {0, 0},
                      {0, out},
                      {along, out},
                      {along, out - 0.1},
                      {0.1, out - 0.1},
                      {0.1, 0},
                      {30, 0},
                      {30, 30},
                      {-30, 30}});
    return domain;
  };
  CleanReport report;
  const Domain coarse = followSizes(harbour(15, 10), ConstantSize(1.0), {}, oneFeature(), report);
  EXPECT_EQ(boundaryLoops(constrainedDelaunay(coarse.pslg)).size(), 1u);
  addWaterNotes(report, {});
  ASSERT_EQ(report.notes.size(), 1u);
  double x = 0.0, y = 0.0, length = 0.0;
  ASSERT_EQ(std::sscanf(report.notes[0].c_str(),
                        "land narrower than an element that ended in water was removed, the longest of 1: (%lf, %lf), "
                        "about %lf long",
                        &x, &y, &length),
            3)
      << report.notes[0];
  EXPECT_NEAR(x, 10.0, 0.5);
  EXPECT_NEAR(y, 15.0, 0.5);
  EXPECT_NEAR(length, 25.0, 1.5);
  CleanReport small, kept;
  followSizes(harbour(2, 0.6), ConstantSize(1.0), {}, oneFeature(), small);
  EXPECT_EQ(countOf(small, EditKind::DroppedSpit), 1u);
  EXPECT_EQ(small.notes, std::vector<std::string>{});
  const Domain walled = followSizes(harbour(15, 10), ConstantSize(1.0), {.land_min = 0.0}, oneFeature(), kept);
  EXPECT_EQ(kept.notes, std::vector<std::string>{});
  EXPECT_TRUE(std::ranges::any_of(walled.pslg.points, [](const Point& p) { return distance(p, {10, 15}) < 0.2; }));
}

}  // namespace
}  // namespace coastmesh
