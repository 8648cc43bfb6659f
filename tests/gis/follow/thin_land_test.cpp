// Islands much thinner than an element that are long enough to stay: detail of their shores must go all the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"
#include "tests/support/mesh_checks.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A water of side 40 around an island 8 long and 0.05 wide that winds, with two rough shores.
Domain windingIsland(unsigned seed) {
  constexpr double kLength = 8.0, kWidth = 0.05, kAside = 0.1, kWave = 0.3, kRough = 0.016;
  constexpr int kPoints = 400;
  std::mt19937 random(seed);
  std::vector<Point> upper, ring;
  for (int i = 0; i <= kPoints; ++i) {
    const double x = kLength * i / kPoints, rough = kRough * (2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0);
    upper.push_back({x, kAside * std::sin(6.283185307179586 * x / kWave + seed) + rough + 0.5 * kWidth});
  }
  ring = upper;
  for (auto p = upper.rbegin(); p != upper.rend(); ++p) ring.push_back({p->x, p->y - kWidth});
  Domain domain;
  addShore(domain, {{-16.0, -20.0}, {24.0, -20.0}, {24.0, 20.0}, {-16.0, 20.0}});
  addShore(domain, ring);
  return domain;
}

double shortestOf(const Domain& domain) {
  double least = 1e9;
  for (const Segment& s : domain.pslg.segments)
    least = std::min(least, distance(domain.pslg.points[s.a], domain.pslg.points[s.b]));
  return least;
}

TEST(ThinLand, KeepsNoSegmentsMuchShorterThanTheSize) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Domain domain = windingIsland(seed);
    const double area = areaOf(domain);
    CleanReport report;
    const Domain followed = followSizes(std::move(domain), ConstantSize(1.0), {}, oneFeature(), report);
    EXPECT_GE(shortestOf(followed), 0.45) << seed;
    EXPECT_NEAR(areaOf(followed), area, 0.005 * area) << seed;
    EXPECT_EQ(boundaryLoops(constrainedDelaunay(followed.pslg)).size(), 2u) << seed;
    warnOfShortSegments(followed, ConstantSize(1.0), report);
    EXPECT_THAT(report.warnings, IsEmpty()) << seed;
  }
}

// A square water of side 40 with a notch 0.1 deep in its lower side, where sizes are 1.
Domain notched() {
  Domain domain;
  addShore(domain, {{0, 0}, {20, 0}, {20.05, 0.1}, {20.1, 0}, {40, 0}, {40, 40}, {0, 40}});
  return domain;
}

TEST(ShortSegments, ThatStayAreWarnedOf) {
  CleanReport report;
  warnOfShortSegments(notched(), ConstantSize(1.0), report);
  ASSERT_THAT(report.warnings, ElementsAre(HasSubstr("2 segments are much shorter, the shortest at (20.0")));
  EXPECT_THAT(report.warnings[0], HasSubstr("0.112 long where the size is 1;"));
}

TEST(ShortSegments, ThatTheUserAskedForAreNotWarnedOf) {
  Domain asked = notched();
  asked.asked = {1, 3};
  Domain crossed = notched();
  crossed.pslg.points.push_back({20.05, 20.0});
  crossed.pslg.segments.push_back({2, 7, kFirstLineTag, 0, 0});
  crossed.lines.emplace_back();
  crossed.input_points = crossed.pslg.points;
  for (const Domain& domain : {asked, crossed}) {
    CleanReport report;
    warnOfShortSegments(domain, ConstantSize(1.0), report);
    EXPECT_THAT(report.warnings, IsEmpty());
  }
}

TEST(ShortSegments, NeitherAreThoseOfAWaterSmallerThanAnElement) {
  Domain pond;
  addRing(pond, {0.0, 0.0}, 0.1, 12, false);
  CleanReport report;
  warnOfShortSegments(pond, ConstantSize(1.0), report);
  EXPECT_THAT(report.warnings, IsEmpty());
}

}  // namespace
}  // namespace coastmesh
