#include "gis/shore/data_shores.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace coastmesh {
namespace {

// Water of 10 by 10, with an island of 2 by 2 in its middle.
Pslg lakeWithAnIsland() {
  Pslg pslg;
  const auto add = [&](const std::vector<Point>& ring) {
    const auto first = static_cast<VertexId>(pslg.points.size()), count = static_cast<VertexId>(ring.size());
    for (VertexId i = 0; i < count; ++i) {
      pslg.points.push_back(ring[i]);
      pslg.segments.push_back({first + i, first + (i + 1) % count, 0, 0, kOutside});
    }
  };
  add({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  add({{4, 4}, {4, 6}, {6, 6}, {6, 4}});
  return pslg;
}

TEST(DataShores, PiecesRunWithTheWaterToTheirLeft) {
  const DataShores shores(lakeWithAnIsland());
  const std::vector<VertexId> found = shores.find({{10, 10}, {3, 3}, {4, 6}, {10, 10}});
  EXPECT_EQ(found, (std::vector<VertexId>{2, kNone, 5, 2}));
  const Box all{-1, -1, 11, 11};
  EXPECT_EQ(shores.piece(0, {10, 10}, all), (std::vector<Point>{{0, 0}, {10, 0}, {10, 10}}));
  EXPECT_TRUE(shores.piece(0, {10, 10}, {-1, -1, 9, 11}).empty());
  EXPECT_TRUE(shores.piece(0, {4, 4}, all).empty());
}

TEST(DataShores, IslandsAreFoundAcrossALine) {
  const DataShores shores(lakeWithAnIsland());
  const DataShores::Islands islands =
      shores.islandsAcross({{{1, 1}, {9, 9.5}, 1.0}, {{1, 2}, {9, 2}, 1.0}, {{1, 5}, {9, 5}, 1.0}});
  ASSERT_EQ(islands.rings.size(), 1u);
  EXPECT_EQ(islands.rings[0].size(), 5u);
  EXPECT_EQ(islands.rings[0].front(), islands.rings[0].back());
  EXPECT_EQ(islands.across, (std::vector<std::vector<std::size_t>>{{0}, {}, {0}}));
  // The shore of the lake itself leaves the reach of this line.
  EXPECT_TRUE(shores.islandsAcross({{{9, 9}, {12, 9}, 1.0}}).rings.empty());
}

TEST(DataShores, GapsAreAcrossWater) {
  // The northern shore runs west, the southern one east: the water between them is to the left of both.
  const std::vector<Point> south{{0, 0}, {5, 1}, {10, 0}}, north{{10, 3}, {0, 3}};
  const ShoreGap gap = gapBetween(south, north);
  EXPECT_DOUBLE_EQ(gap.width, 2.0);
  EXPECT_EQ(gap.middle, (Point{5, 2}));
  EXPECT_DOUBLE_EQ(gapBetween(north, south).width, 2.0);
  const std::vector<Point> back{{0, 3}, {10, 3}};  // the other side of a spit
  EXPECT_EQ(gapBetween(south, back).width, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace coastmesh
