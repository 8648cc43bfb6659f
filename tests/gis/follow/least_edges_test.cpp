#include "gis/follow/least_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "tests/support/followed_coasts.hpp"

namespace coastmesh {
namespace {

// A lake of radius 20 with an uneven shore of segments about 0.6 long.
Domain finelyCutLake() {
  Domain lake;
  std::vector<Point> ring;
  constexpr int kCount = 210;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCount, radius = 20.0 + 0.1 * (i % 3);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  addShore(lake, ring);
  return lake;
}

double shortestOf(const Domain& domain) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s : domain.pslg.segments)
    least = std::min(least, distance(domain.pslg.points[s.a], domain.pslg.points[s.b]));
  return least;
}

TEST(LengthenShores, LeavesNoShorterSegments) {
  const Domain lake = finelyCutLake();
  ASSERT_LT(shortestOf(lake), 0.65);
  CleanReport report;
  const Domain longer = lengthenShores(Domain(lake), {.least_m = 0.7}, ConstantSize(1.0), oneFeature(), report);
  EXPECT_GE(shortestOf(longer), 0.7);
  EXPECT_NEAR(areaOf(longer) / areaOf(lake), 1.0, 0.005);
  EXPECT_EQ(longer.input_points.size(), longer.pslg.points.size());
  EXPECT_GT(countOf(report, EditKind::SimplifiedPoint) + countOf(report, EditKind::MovedPoint), 0u);
}

TEST(LengthenShores, LeavesLongerSegmentsAlone) {
  const Domain lake = finelyCutLake();
  CleanReport report;
  const Domain same = lengthenShores(Domain(lake), {.least_m = 0.5}, ConstantSize(1.0), oneFeature(), report);
  EXPECT_EQ(same.pslg.points, lake.pslg.points);
  EXPECT_TRUE(report.edits.empty());
}

// A sea with a bay one element wide and two long.
Domain squareBay() {
  Domain sea;
  std::vector<Point> ring{{-5.0, 0.0}, {-2.5, 0.0}, {0.0, 0.0}, {0.0, -1.0}, {0.0, -2.0}, {1.0, -2.0},
                          {1.0, -1.0}, {1.0, 0.0},  {3.5, 0.0}, {6.0, 0.0},  {6.0, 8.0},  {-5.0, 8.0}};
  addShore(sea, ring);
  return sea;
}

// The largest deviation of a corner at the end of the bay from a right angle, degrees.
double offSquare(const Domain& domain) {
  double off = 0.0;
  const auto& points = domain.pslg.points;
  for (const Segment& in : domain.pslg.segments) {
    for (const Segment& out : domain.pslg.segments) {
      if (in.b != out.a || points[in.b].y > -1.6) continue;
      const double angle = 180.0 / std::numbers::pi * angleAt(points[in.b], points[in.a], points[out.b]);
      off = std::max(off, std::abs(angle - 90.0));
    }
  }
  return off;
}

TEST(LengthenShores, MakesEndsOfNarrowWaterPointedOrRound) {
  CleanReport report;
  const EdgeWishes any{.least_m = 0.7}, centred{.least_m = 0.7, .no_square_ends = true};
  EXPECT_EQ(offSquare(lengthenShores(squareBay(), any, ConstantSize(1.0), oneFeature(), report)), 0.0);
  const Domain pointed = lengthenShores(squareBay(), centred, ConstantSize(1.0), oneFeature(), report);
  EXPECT_GT(offSquare(pointed), 12.0);
  EXPECT_GE(shortestOf(pointed), 0.7);
}

}  // namespace
}  // namespace coastmesh
