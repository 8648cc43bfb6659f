#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "gis/clean/clean.hpp"
#include "gis/error.hpp"
#include "tests/support/even_odd_area.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {
namespace {

// Compares areas with even-odd areas computed from the coordinates alone.
void expectCleanable(const std::vector<Feature>& features, double tolerance) {
  const Coastline coastline = coastlineOf(features);
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), {.snap_m = 0}, report);
  ASSERT_EQ(defectOfLabelled(domain.pslg), "");
  const std::vector<double> areas = evenOddAreas(features);
  for (std::size_t f = 0; f < features.size(); ++f) {
    EXPECT_NEAR(labelledArea(domain.pslg, static_cast<RegionId>(f)), areas[f], tolerance) << "feature " << f;
  }
  CleanReport again;
  const Domain second = cleanFeatures(coastline, allMembers(coastline), Projection::plane(), {.snap_m = 0}, again);
  EXPECT_EQ(second.pslg.points, domain.pslg.points);
}

class CleanRandom : public ::testing::TestWithParam<unsigned> {};

TEST_P(CleanRandom, TangledRing) {
  std::mt19937_64 random(GetParam());
  expectCleanable({polygonFeature(1, tangledRing(random, 5 + 8 * (GetParam() % 10)))}, 1e-9);
}

TEST_P(CleanRandom, TangledFeaturesOverEachOther) {
  std::mt19937_64 random(1000 + GetParam());
  std::vector<Feature> features;
  for (int f = 0; f < 3; ++f) features.push_back(polygonFeature(f, tangledRing(random, 12), {tangledRing(random, 5)}));
  expectCleanable(features, 1e-9);
}

TEST_P(CleanRandom, RingsOnAGridOfPlaces) {
  std::mt19937_64 random(2000 + GetParam());
  std::vector<Feature> features;
  for (int f = 0; f < 3; ++f) features.push_back(polygonFeature(f, gridRing(random, 20, 5), {gridRing(random, 6, 5)}));
  expectCleanable(features, 1e-9);
}

TEST_P(CleanRandom, FarFromTheOrigin) {
  std::mt19937_64 random(3000 + GetParam());
  Ring ring = tangledRing(random, 40);
  for (Point& p : ring) p = {p.x + 1e6, p.y - 3e6};
  // Crossings are rounded to the grain of the coordinates, about 5e-10, and points closer than 2e-7 are merged.
  expectCleanable({polygonFeature(1, ring)}, 1e-5);
}

TEST_P(CleanRandom, NearlyParallelNeedles) {
  std::mt19937_64 random(4000 + GetParam());
  std::uniform_real_distribution<double> tiny(-1e-12, 1e-12);
  Ring ring;
  for (int i = 0; i < 30; ++i) {
    const double dx = tiny(random), dy = tiny(random);
    ring.push_back({(i % 2) + dx, dy});
  }
  ring.push_back({0.5, 1});
  expectCleanable({polygonFeature(1, ring)}, 1e-9);
}

TEST_P(CleanRandom, ClustersNearerThanRounding) {
  std::mt19937_64 random(8000 + GetParam());
  std::uniform_real_distribution<double> tiny(-1e-14, 1e-14);
  Ring ring = gridRing(random, 50, 6);
  for (Point& p : ring) {
    const double dx = tiny(random), dy = tiny(random);
    p = {p.x / 3 + dx, p.y / 7 + dy};
  }
  expectCleanable({polygonFeature(1, ring)}, 1e-9);
}

TEST_P(CleanRandom, StarsAndIslandsNeedNoEdit) {
  std::mt19937_64 random(5000 + GetParam());
  const Feature feature = polygonFeature(1, starRing(random, {0, 0}, 10, 200),
                                         {starRing(random, {1, 1}, 1.5, 50), starRing(random, {-2, 0}, 1, 9)});
  const Coastline coastline = coastlineOf({feature});
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0}, Projection::plane(), {.snap_m = 0}, report);
  EXPECT_TRUE(report.edits.empty());
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  EXPECT_EQ(domain.pslg.points.size(), 259u);
  EXPECT_NEAR(labelledArea(domain.pslg, 0), evenOddAreas({feature})[0], 1e-9);
}

TEST_P(CleanRandom, EveryInputVertexThatBoundsTheDomainStays) {
  std::mt19937_64 random(6000 + GetParam());
  const Ring ring = tangledRing(random, 25);
  const Coastline coastline = coastlineOf({polygonFeature(1, ring)});
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0}, Projection::plane(), {.snap_m = 0}, report);
  // Every edge of a self-crossing ring separates inside from outside along its whole length.
  for (std::size_t i = 0; i < ring.size(); ++i) EXPECT_EQ(domain.input_points[i], ring[i]);
  EXPECT_EQ(domain.pslg.points.size(), ring.size() + report.counts[static_cast<std::size_t>(EditKind::SelfCrossing)]);
}

TEST_P(CleanRandom, AnySnapDistanceMakesAValidGraph) {
  std::mt19937_64 random(7000 + GetParam());
  for (const double snap : {1e-6, 1e-3, 0.02, 0.1}) {
    const Coastline coastline = coastlineOf(
        {polygonFeature(1, tangledRing(random, 40)), polygonFeature(2, starRing(random, {0.5, 0.5}, 0.5, 60))});
    CleanReport report;
    const Domain domain = cleanFeatures(coastline, {0, 1}, Projection::plane(), {.snap_m = snap}, report);
    EXPECT_EQ(defectOfLabelled(domain.pslg), "") << "snap " << snap;
  }
}

// Here the graph is unfinished when the rounds that merge close vertices begin. Edges that these rounds leave unchanged
// must be checked as well, or two of them cross.
TEST(Clean, WhatIsNewAndNotMovedIsLookedAtInTheLastRounds) {
  std::mt19937_64 random(189);
  const Coastline coastline = coastlineOf({polygonFeature(1, tangledRing(random, 40))});
  CleanReport report;
  const Domain domain = cleanFeatures(coastline, {0}, Projection::plane(), {.snap_m = 0.1}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
}

INSTANTIATE_TEST_SUITE_P(Seeds, CleanRandom, ::testing::Range(0u, 30u));

}  // namespace
}  // namespace coastmesh
