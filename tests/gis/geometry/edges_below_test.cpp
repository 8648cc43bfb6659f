// The edge straight below a place.
#include "gis/geometry/edges_below.hpp"

#include <gtest/gtest.h>

#include <random>

namespace coastmesh {
namespace {

using Edges = std::vector<std::pair<VertexId, VertexId>>;

TEST(EdgesBelow, TheHighestThatIsNotAbove) {
  const std::vector<Point> points{{0, 0}, {10, 0}, {0, 4}, {10, 6}, {5, 5}};
  const Edges edges{{0, 1}, {3, 2}};
  const EdgesBelow below(points, edges);
  EXPECT_EQ(below.at({5, -1}), kNone);
  EXPECT_EQ(below.at({5, 0}), 0u);
  EXPECT_EQ(below.at({5, 4.9}), 0u);
  EXPECT_EQ(below.at({5, 5}), 1u);
  EXPECT_EQ(below.at({5, 100}), 1u);
  EXPECT_EQ(below.at({0, 100}), 1u);
  EXPECT_EQ(below.at({10, 100}), kNone);  // the east end does not belong to an edge
  EXPECT_TRUE(below.runsEast(0));
  EXPECT_FALSE(below.runsEast(1));
}

TEST(EdgesBelow, EdgesThatShareAnEndAndVerticalOnes) {
  const std::vector<Point> points{{0, 0}, {10, -5}, {10, 0}, {10, 5}, {0, 10}};
  const Edges edges{{0, 1}, {0, 3}, {0, 2}, {0, 4}};
  const EdgesBelow below(points, edges);
  EXPECT_EQ(below.at({0, 1}), 1u);
  EXPECT_EQ(below.at({5, 1}), 2u);
  EXPECT_EQ(below.at({5, -1}), 0u);
}

// Lines across the whole range of x, one above the other, in a random order.
TEST(EdgesBelow, AmongManyEdges) {
  constexpr VertexId kLines = 500;
  std::mt19937 random(7);
  std::vector<VertexId> rank(kLines);
  for (VertexId i = 0; i < kLines; ++i) rank[i] = i;
  std::shuffle(rank.begin(), rank.end(), random);
  std::vector<Point> points;
  Edges edges;
  for (VertexId i = 0; i < kLines; ++i) {
    points.push_back({-1.0 - i, static_cast<double>(rank[i])});
    points.push_back({1.0 + i, rank[i] + 0.5});
    edges.emplace_back(2 * i, 2 * i + 1);
  }
  const EdgesBelow below(points, edges);
  for (VertexId i = 0; i < kLines; ++i) {
    EXPECT_EQ(below.at({0.0, rank[i] + 0.3}), i);
    if (rank[i] > 0) {
      EXPECT_EQ(rank[below.at({0.0, rank[i] + 0.2})], rank[i] - 1);
    }
  }
}

}  // namespace
}  // namespace coastmesh
