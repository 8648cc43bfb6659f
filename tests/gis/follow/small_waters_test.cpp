// Waters in which no element fits stay about as they are: elements as large as the size would enlarge them many times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/follow/coast_follow.hpp"
#include "gis/follow/least_edges.hpp"
#include "tests/gis/follow/shore_distance.hpp"
#include "tests/support/followed_coasts.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

using testing::farthestFrom;

Domain pond() {
  Domain domain;
  addShore(domain, {{0, 0}, {7, 0}, {0, 7}});
  return domain;
}

// A winding river, one wide.
Domain river() {
  constexpr int kCount = 200;
  std::vector<Point> ring;
  const auto middle = [](int i) { return Point{0.5 * i, 8.0 * std::sin(0.2 * i)}; };
  const auto side = [&](int i, double off) {
    const Point along = middle(i + 1) - middle(i - 1);
    const double length = std::sqrt(squaredLength(along));
    ring.push_back(middle(i) + off / length * Point{-along.y, along.x});
  };
  for (int i = 0; i < kCount; ++i) side(i, -0.5);
  for (int i = kCount; i-- > 0;) side(i, 0.5);
  Domain domain;
  addShore(domain, ring);
  return domain;
}

// Water, half of one wide, around an island.
Domain moat(double radius) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, radius, 120, false);
  addRing(domain, {0.0, 0.0}, radius - 0.5, 120, true);
  return domain;
}

// Thinned for the size, followed, and with segments lengthened to the size.
Domain followed(const Domain& water, double size, const FollowOptions& options, CleanReport& report) {
  FollowStart start;
  Domain coarse = thinToLeast(Domain(water), size, options, oneFeature(), {}, report, start);
  coarse =
      followSizes(std::move(coarse), ConstantSize(size), options, oneFeature(), report, {}, inOrder, std::move(start));
  return lengthenShores(std::move(coarse), {.least_m = 0.5 * size}, ConstantSize(size), oneFeature(), report);
}

TEST(SmallWaters, KeepTheirAreaHoweverLargeTheSizes) {
  for (const Domain& water : {pond(), river(), moat(5.0), moat(20.0), moat(200.0)}) {
    for (const double size : {16.0, 60.0, 1000.0}) {
      for (const FollowOptions& options :
           {FollowOptions{}, FollowOptions{.channel_min = 0.0}, FollowOptions{.land_min = 0.0}}) {
        CleanReport report;
        const Domain coarse = followed(water, size, options, report);
        EXPECT_NEAR(areaOf(coarse) / areaOf(water), 1.0, 0.1) << size;
      }
    }
  }
}

TEST(SmallWaters, MoveByLessThanTheirWidth) {
  for (const auto& [water, width] : {std::pair(pond(), 2.0), std::pair(river(), 1.0), std::pair(moat(20.0), 0.5)}) {
    CleanReport report;
    const Domain coarse = followed(water, 60.0, {}, report);
    EXPECT_LT(farthestFrom(water.pslg.points, coarse), width);
    EXPECT_LT(farthestFrom(coarse.pslg.points, water), width);
  }
}

TEST(SmallWaters, AreStillAsCoarseAsTheirWidthAllows) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 5.0, 600, false, 0.0004);
  const double area = areaOf(domain);
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(30.0), {}, oneFeature(), report);
  EXPECT_LE(coarse.pslg.points.size(), 10u);
  EXPECT_NEAR(areaOf(coarse) / area, 1.0, 0.1);
}

// A lake beside a pond of another feature.
TEST(SmallWaters, KeepTheirAreaBesideLargerOnes) {
  Coastline lakes = oneFeature();
  lakes.features.push_back(lakes.features.front());
  Domain domain;
  addRing(domain, {0.0, 0.0}, 100.0, 600, false);
  const std::size_t first = domain.pslg.segments.size();
  addRing(domain, {120.0, 0.0}, 5.0, 60, false);
  addRing(domain, {120.0, 0.0}, 2.0, 30, true);
  for (std::size_t s = first; s < domain.pslg.segments.size(); ++s)
    for (RegionId* side : {&domain.pslg.segments[s].left, &domain.pslg.segments[s].right})
      if (*side >= 0) *side = 1;
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(25.0), {}, lakes, report);
  double pond = 0.0;
  for (const Segment& s : coarse.pslg.segments)
    if (s.left == 1 || s.right == 1)
      pond += (s.left == 1 ? 0.5 : -0.5) * cross(coarse.pslg.points[s.a], coarse.pslg.points[s.b]);
  EXPECT_NEAR(pond, std::numbers::pi * (25.0 - 4.0), 0.1 * std::numbers::pi * 21.0);
}

// Only waters without room for an element: larger ones are generalised.
TEST(SmallWaters, WaterWithRoomForElementsFollowsTheSizes) {
  Domain domain;
  addRing(domain, {0.0, 0.0}, 50.0, 600, false);
  addRing(domain, {0.0, 0.0}, 4.0, 40, true);
  CleanReport report;
  const Domain coarse = followSizes(std::move(domain), ConstantSize(20.0), {}, oneFeature(), report);
  EXPECT_EQ(countOf(report, EditKind::SmallIsland), 1u);
  for (const Segment& s : coarse.pslg.segments)
    EXPECT_GE(distance(coarse.pslg.points[s.a], coarse.pslg.points[s.b]), 0.45 * 20.0);
}

}  // namespace
}  // namespace coastmesh
