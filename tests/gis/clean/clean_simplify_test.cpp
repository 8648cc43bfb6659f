#include <gtest/gtest.h>

#include <cmath>

#include "gis/clean/clean.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {
namespace {

double distanceTo(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

double distanceTo(const Point& p, const Pslg& pslg) {
  double least = 1e300;
  for (const Segment& s : pslg.segments) least = std::min(least, distanceTo(p, pslg.points[s.a], pslg.points[s.b]));
  return least;
}

// The least distance of a point from a segment that does not end there.
double leastWidth(const Pslg& pslg) {
  double least = 1e300;
  for (VertexId v = 0; v < pslg.points.size(); ++v)
    for (const Segment& s : pslg.segments)
      if (s.a != v && s.b != v) least = std::min(least, distanceTo(pslg.points[v], pslg.points[s.a], pslg.points[s.b]));
  return least;
}

Domain simplify(const std::vector<Feature>& features, double tolerance, CleanReport& report) {
  const Coastline coastline = coastlineOf(features);
  const Domain domain = cleanFeatures(coastline, allMembers(coastline), Projection::plane(),
                                      {.snap_m = 0, .simplify_m = tolerance}, report);
  EXPECT_EQ(defectOfLabelled(domain.pslg), "");
  return domain;
}

TEST(Simplify, DropsWhatLiesWithinTheTolerance) {
  CleanReport report;
  const Domain domain =
      simplify({polygonFeature(1, {{0, 0}, {5, 0.1}, {10, 0}, {10, 5}, {10.2, 6}, {10, 10}, {0, 10}})}, 0.15, report);
  EXPECT_EQ(domain.input_points, (Ring{{0, 0}, {10, 0}, {10, 5}, {10.2, 6}, {10, 10}, {0, 10}}));
  EXPECT_EQ(report.counts[static_cast<std::size_t>(EditKind::SimplifiedPoint)], 1u);
  CleanReport coarse;
  EXPECT_EQ(
      simplify({polygonFeature(1, {{0, 0}, {5, 0.1}, {10, 0}, {10, 5}, {10.2, 6}, {10, 10}, {0, 10}})}, 0.5, coarse)
          .pslg.points.size(),
      4u);
}

TEST(Simplify, AnIslandKeepsItsSide) {
  // The shore bulges around an island: without the bulge, the island would be on land.
  const Ring shore{{0, 0}, {4, 0}, {5, -2}, {6, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Ring island{{4.9, -0.5}, {5.1, -0.5}, {5, -0.3}};
  CleanReport report;
  const Domain with_island = simplify({polygonFeature(1, shore, {island})}, 3, report);
  EXPECT_NE(std::find(with_island.input_points.begin(), with_island.input_points.end(), Point{5, -2}),
            with_island.input_points.end());
  const Domain without = simplify({polygonFeature(1, shore)}, 3, report);
  EXPECT_EQ(std::find(without.input_points.begin(), without.input_points.end(), Point{5, -2}),
            without.input_points.end());
}

TEST(Simplify, NoLakeIsFlattened) {
  // Three points lie almost on a line; those between them are the least important.
  const Ring lake{{-236.6, 3580.7}, {316.9, 2521.0},    {-16.06, 758.527}, {-236.8, 758.539},
                  {-236.9, -323.5}, {-1200.3, 758.819}, {-236.8, 1639.8}};
  CleanReport report;
  EXPECT_GT(leastWidth(simplify({polygonFeature(1, lake)}, 568, report).pslg), 10);
}

TEST(Simplify, JunctionsAndRingsStay) {
  // Two features share a wavy border; tiny islands do not vanish.
  const Ring left{{0, 0}, {5, 0}, {5.1, 2}, {4.9, 4}, {5, 6}, {0, 6}};
  const Ring right{{5, 0}, {10, 0}, {10, 6}, {5, 6}, {4.9, 4}, {5.1, 2}};
  CleanReport report;
  const Domain domain = simplify({polygonFeature(1, left, {square(1, 1, 0.01)}), polygonFeature(2, right)}, 1, report);
  EXPECT_EQ(domain.pslg.points.size(), 9u);
  EXPECT_NEAR(labelledArea(domain.pslg, 1), 30, 1e-12);
}

Feature requestedPoints(std::vector<Point> points) {
  Feature feature;
  feature.use = FeatureUse::Constraint;
  feature.points = std::move(points);
  return feature;
}

TEST(Simplify, RequestedPointsOnShoresStay) {
  const Feature lake = polygonFeature(1, {{0, 0}, {5, 0.1}, {10, 0}, {10, 10}, {5, 9.9}, {0, 10}});
  CleanReport report;
  const Domain domain = simplify({lake, requestedPoints({{5, 0.1}})}, 0.5, report);
  EXPECT_EQ(domain.input_points, (Ring{{0, 0}, {5, 0.1}, {10, 0}, {10, 10}, {0, 10}}));
  ASSERT_EQ(domain.asked.size(), 1u);
  EXPECT_EQ(domain.pslg.points[domain.asked[0]], (Point{5, 0.1}));
  // The end of an edge that is dissolved.
  const Coastline halves = coastlineOf(
      {polygonFeature(1, square(0, 0, 10)), polygonFeature(2, square(10, 0, 10)), requestedPoints({{10, 0}})});
  CleanReport dissolved;
  const Domain whole =
      cleanFeatures(halves, allMembers(halves), Projection::plane(), {.snap_m = 0, .dissolve = true}, dissolved);
  EXPECT_EQ(whole.pslg.points.size(), 5u);
  ASSERT_EQ(whole.asked.size(), 1u);
  EXPECT_EQ(whole.pslg.points[whole.asked[0]], (Point{10, 0}));
}

class SimplifyRandom : public ::testing::TestWithParam<unsigned> {};

TEST_P(SimplifyRandom, StaysWithinTheToleranceAndValid) {
  std::mt19937_64 random(GetParam());
  const Feature feature = polygonFeature(1, starRing(random, {0, 0}, 10, 300),
                                         {starRing(random, {0.5, 0.5}, 2.5, 80), starRing(random, {-3, 0}, 1.5, 40)});
  const Feature tangled = polygonFeature(2, tangledRing(random, 30));
  for (const double tolerance : {0.01, 0.2, 1.0, 50.0}) {
    CleanReport plain_report, report;
    const Coastline coastline = coastlineOf({feature, tangled});
    const Domain plain = cleanFeatures(coastline, {0, 1}, Projection::plane(), {.snap_m = 0}, plain_report);
    const Domain simple = simplify({feature, tangled}, tolerance, report);
    EXPECT_LT(simple.pslg.points.size(), plain.pslg.points.size());
    EXPECT_EQ(plain.pslg.points.size() - simple.pslg.points.size(),
              report.counts[static_cast<std::size_t>(EditKind::SimplifiedPoint)]);
    for (const Point& p : plain.pslg.points) EXPECT_LE(distanceTo(p, simple.pslg), tolerance * (1 + 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SimplifyRandom, ::testing::Range(0u, 10u));

}  // namespace
}  // namespace coastmesh
