#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/metric.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/gis/follow/shore_distance.hpp"
#include "tests/support/followed_coasts.hpp"

namespace coastmesh {
namespace {

using testing::farthestFrom;

// The ring with vertices along its sides, rotated so that no side is parallel to an axis.
std::vector<Point> dense(const std::vector<Point>& ring, double step, double degrees) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const int count = static_cast<int>(std::max(1.0, std::round(distance(a, b) / step)));
    for (int k = 0; k < count; ++k) points.push_back(a + (1.0 * k / count) * (b - a));
  }
  const double angle = toRadians(degrees);
  for (Point& p : points)
    p = {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle)};
  return points;
}

// Sizes are 1.
TEST(FollowSizes, CornersOfHarboursStayHoweverDenseTheirSidesAre) {
  for (const double width : {3.0, 5.0, 8.0}) {
    const double w = 0.5 * width;
    const std::vector<std::vector<Point>> shores{
        // a pier, an L of piers, a slip
        {{-20, -20}, {-w, -20}, {-w, 5}, {w, 5}, {w, -20}, {20, -20}, {20, 30}, {-20, 30}},
        {{-20, -20},
         {-w, -20},
         {-w, 5 + width},
         {15, 5 + width},
         {15, 5},
         {w, 5},
         {w, -20},
         {20, -20},
         {20, 30},
         {-20, 30}},
        {{-20, 0}, {-w, 0}, {-w, -15}, {w, -15}, {w, 0}, {20, 0}, {20, 30}, {-20, 30}},
    };
    for (const std::vector<Point>& shore : shores) {
      for (const double step : {0.07, 0.23, 0.45, 100.0}) {
        for (const double degrees : {7.0, 45.0}) {
          const std::vector<Point> ring = dense(shore, step, degrees);
          Domain domain;
          addShore(domain, ring);
          CleanReport report;
          const Domain coarse = followSizes(std::move(domain), ConstantSize(1.0), {}, oneFeature(), report);
          EXPECT_LE(farthestFrom(ring, coarse), 0.2) << width << " wide, vertices " << step << " apart, " << degrees;
          EXPECT_LT(coarse.pslg.points.size(), 200U);
          EXPECT_EQ(countOf(report, EditKind::DroppedSpit), 0U);
          EXPECT_EQ(countOf(report, EditKind::ClosedWater), 0U);
        }
      }
    }
  }
}

// A cape of 60 degrees is cut off where it is an element wide.
TEST(FollowSizes, SharpCornersAreCutOff) {
  Domain domain;
  addShore(domain,
           dense({{-20, -20}, {-5, -20}, {-5, 0}, {5, 5.774}, {5, -20}, {20, -20}, {20, 30}, {-20, 30}}, 0.23, 0.0));
  CleanReport report;
  followSizes(std::move(domain), ConstantSize(1.0), {}, oneFeature(), report);
  EXPECT_EQ(countOf(report, EditKind::DroppedSpit), 1U);
}

}  // namespace
}  // namespace coastmesh
