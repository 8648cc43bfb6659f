#include "gis/grid/mesh_edges.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using Edge = std::array<std::uint32_t, 2>;

// Triangles of any corners: edges of one, two and many of them, and nodes without any.
TEST(UniqueEdges, AreThoseOfASet) {
  std::mt19937 random(11);
  for (const std::uint32_t nodes : {3u, 50u, 30000u}) {
    std::uniform_int_distribution<std::uint32_t> any(0, nodes - 1);
    std::vector<std::array<std::uint32_t, 3>> triangles(40000);
    std::set<Edge> expected;
    for (auto& corners : triangles) {
      for (std::uint32_t& corner : corners) corner = any(random);
      const auto& [a, b, c] = corners;
      for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}})
        expected.insert({std::min(from, to), std::max(from, to)});
    }
    const std::vector<Edge> in_order(expected.begin(), expected.end());
    EXPECT_EQ(uniqueEdges(nodes, triangles), in_order);
    EXPECT_EQ(uniqueEdges(nodes, triangles, testing::backwards), in_order);
  }
  EXPECT_TRUE(uniqueEdges(5, {}).empty());
  EXPECT_TRUE(uniqueEdges(0, {}).empty());
}

}  // namespace
}  // namespace coastmesh
