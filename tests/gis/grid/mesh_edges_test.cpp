#include "gis/grid/mesh_edges.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/support/bulk_lists.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using Edge = std::array<std::uint32_t, 2>;

// Random triangles: edges of one, two and many triangles, and nodes without triangles.
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

// Numbers that follow the geometry, as in the files of most programs, with the shore's before all others.
TEST(UniqueEdges, OfAStripThatFollowsItsNumbers) {
  constexpr std::uint32_t kColumns = 20000;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Edge> expected;
  for (std::uint32_t column = 0; column + 1 < kColumns; ++column) {
    const std::uint32_t shore = column, inner = kColumns + column;
    triangles.push_back({shore, shore + 1, inner});
    triangles.push_back({shore + 1, inner + 1, inner});
    expected.insert(expected.end(), {{shore, shore + 1}, {shore, inner}, {shore + 1, inner}, {inner, inner + 1}});
  }
  expected.push_back({kColumns - 1, 2 * kColumns - 1});
  std::ranges::sort(expected);
  EXPECT_EQ(uniqueEdges(2 * kColumns, triangles), expected);
  EXPECT_EQ(uniqueEdges(2 * kColumns, triangles, testing::backwards), expected);
}

// Rows of triangles that begin at the shore, whose nodes come before all others: they have edges all over the mesh.
TEST(UniqueEdges, OfRowsThatBeginAtTheShore) {
  constexpr std::uint32_t kRows = 1000, kColumns = 300;
  const auto node = [](std::uint32_t row, std::uint32_t column) {
    return column == 0 ? row : kRows + row * (kColumns - 1) + column - 1;
  };
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::set<Edge> expected;
  for (std::uint32_t row = 0; row + 1 < kRows; ++row) {
    for (std::uint32_t column = 0; column + 1 < kColumns; ++column) {
      const std::uint32_t a = node(row, column), b = node(row, column + 1), c = node(row + 1, column + 1),
                          d = node(row + 1, column);
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
      for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}, Edge{c, d}, Edge{d, a}})
        expected.insert({std::min(from, to), std::max(from, to)});
    }
  }
  const std::vector<Edge> in_order(expected.begin(), expected.end());
  EXPECT_EQ(uniqueEdges(kRows * kColumns, triangles), in_order);
  EXPECT_EQ(uniqueEdges(kRows * kColumns, triangles, testing::backwards), in_order);
}

}  // namespace
}  // namespace coastmesh
