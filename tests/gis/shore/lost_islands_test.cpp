#include "gis/shore/lost_islands.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/metric.hpp"
#include "core/triangulate/label_regions.hpp"

namespace coastmesh {
namespace {

void addRing(Pslg& pslg, const std::vector<Point>& ring) {
  const auto first = static_cast<VertexId>(pslg.points.size()), n = static_cast<VertexId>(ring.size());
  pslg.points.insert(pslg.points.end(), ring.begin(), ring.end());
  for (VertexId i = 0; i < n; ++i) pslg.segments.push_back({first + i, first + (i + 1) % n});
}

const std::vector<Point> kSea{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
const std::vector<Point> kLong{{10, 10}, {50, 10}, {50, 13}, {10, 13}};   // 120
const std::vector<Point> kRound{{60, 60}, {80, 60}, {80, 80}, {60, 80}};  // 400
const std::vector<Point> kRock{{20, 80}, {22, 80}, {22, 82}, {20, 82}};   // 4

Pslg sea(const std::vector<std::vector<Point>>& islands) {
  Pslg pslg;
  addRing(pslg, kSea);
  for (const std::vector<Point>& island : islands) {
    addRing(pslg, island);
    pslg.holes.push_back(centroid(island[0], island[1], island[2]));
  }
  labelSegments(pslg);
  return pslg;
}

std::vector<LostIsland> lost(const Pslg& before, const Pslg& after) {
  const ScaleTable scales(Projection::plane(), Box::of({0, 0}, {100, 100}));
  return lostIslands(islandRings(before), after, ConstantSize(5.0), scales, 2.0);
}

TEST(LostIslands, AreThoseOfWhichNothingIsLeft) {
  const Pslg before = sea({kLong, kRound, kRock});
  ASSERT_EQ(islandRings(before).size(), 3u);
  EXPECT_TRUE(lost(before, before).empty());
  // The rock is smaller than two elements.
  const std::vector<LostIsland> gone = lost(before, sea({kRound}));
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_NEAR(gone[0].area_m2, 120.0, 1e-9);
  EXPECT_GT(gone[0].place.x, 10.0);
  EXPECT_LT(gone[0].place.y, 13.0);
  EXPECT_EQ(lost(before, sea({})).size(), 2u);
}

TEST(LostIslands, NotThoseThatMovedOrGrewTogether) {
  const Pslg before = sea({kLong, kRound});
  // A part of one, and land that holds both.
  EXPECT_TRUE(lost(before, sea({{{12, 11}, {30, 11}, {30, 12.5}}, kRound})).empty());
  EXPECT_TRUE(lost(before, sea({{{5, 5}, {90, 5}, {90, 90}, {55, 85}}})).empty());
  // A sliver across its end, with no corner in it.
  EXPECT_TRUE(lost(before, sea({{{8, 9}, {15, 16}, {9, 20}}, kRound})).empty());
}

}  // namespace
}  // namespace coastmesh
