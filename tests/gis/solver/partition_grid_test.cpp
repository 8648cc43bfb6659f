#include "gis/solver/partition_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/solver/mesh_graph.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/gis/quad_samples.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using coastmesh::testing::sampleGrid;
using ::testing::HasSubstr;

// Two lakes of 2 x 40 x 40 triangles each, the first less an island.
Grid lakes(int cells = 40) { return sampleGrid(Crs{}, {0.0, 0.0}, 10.0, cells); }

std::set<std::pair<std::size_t, std::size_t>> edgesOf(const MeshGraph& graph) {
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (std::size_t v = 0; v < graph.size(); ++v)
    for (auto e = graph.first[v]; e < graph.first[v + 1]; ++e)
      edges.emplace(v, static_cast<std::size_t>(graph.neighbours[static_cast<std::size_t>(e)]));
  return edges;
}

TEST(MeshGraph, JoinsTrianglesThatShareTwoNodes) {
  const Grid grid = lakes(5);
  const MeshGraph graph = elementGraph(grid);
  ASSERT_EQ(graph.size(), grid.triangles.size());
  std::set<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    for (std::size_t u = 0; u < grid.triangles.size(); ++u) {
      const auto shared = std::ranges::count_if(grid.triangles[t], [&](std::uint32_t node) {
        return std::ranges::find(grid.triangles[u], node) != grid.triangles[u].end();
      });
      if (t != u && shared == 2) expected.emplace(t, u);
    }
  }
  EXPECT_EQ(edgesOf(graph), expected);
  EXPECT_EQ(graph.neighbours.size(), expected.size());
}

TEST(MeshGraph, QuadrilateralsAreOneElement) {
  const Grid grid = coastmesh::testing::mixedGrid(4, 3, [](int i, int j) { return (i + j) % 2 == 0; });
  const auto elements = coastmesh::testing::elementsOf(grid);
  const MeshGraph graph = elementGraph(grid);
  ASSERT_EQ(graph.size(), elements.size());
  std::set<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (std::size_t f = 0; f < elements.size(); ++f) {
      const auto shared = std::ranges::count_if(
          elements[e], [&](std::uint32_t node) { return std::ranges::count(elements[f], node) > 0; });
      if (e != f && shared == 2) expected.emplace(e, f);
    }
  EXPECT_EQ(edgesOf(graph), expected);
  EXPECT_EQ(graph.neighbours.size(), expected.size());
}

// In a chain of two elements around a hole both sides are common; the graph has that edge once.
TEST(MeshGraph, ElementsWithTwoCommonSidesAreJoinedOnce) {
  Grid grid;
  grid.nodes = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}};
  addElement(grid, std::array<std::uint32_t, 4>{0, 1, 4, 3});  // not convex: around the corner
  addElement(grid, std::array<std::uint32_t, 4>{1, 2, 3, 4});
  const MeshGraph graph = elementGraph(grid);
  EXPECT_EQ(edgesOf(graph), (std::set<std::pair<std::size_t, std::size_t>>{{0, 1}, {1, 0}}));
  EXPECT_EQ(graph.neighbours.size(), 2u);
}

TEST(PartitionGrid, HalvesGetThePartOfTheirQuadrilateral) {
  Grid grid = coastmesh::testing::mixedGrid(20, 12, [](int i, int) { return i % 3 > 0; });
  const std::size_t elements = coastmesh::testing::elementsOf(grid).size();
  const PartitionReport report = partitionGrid(grid, {.parts = 5, .elements = true});
  ASSERT_EQ(grid.part_of.size(), grid.triangles.size());
  for (const Quad& quad : quadsOf(grid)) EXPECT_EQ(grid.part_of[quad.halves[0]], grid.part_of[quad.halves[1]]);
  EXPECT_LE(report.elements->most, elements / 5 + 2);
}

TEST(MeshGraph, JoinsNodesOfATriangleAndAcrossWeirs) {
  Grid grid = lakes(5);
  addNode(grid, {-100.0, -100.0});
  Boundary& weir = grid.boundaries[0];
  weir.back_nodes.assign(weir.nodes.size(), grid.triangles.back()[0]);
  const MeshGraph graph = nodeGraph(grid);
  ASSERT_EQ(graph.size(), grid.nodes.size());
  std::set<std::pair<std::size_t, std::size_t>> expected;
  for (const auto& corners : grid.triangles)
    for (const std::uint32_t a : corners)
      for (const std::uint32_t b : corners)
        if (a != b) expected.emplace(a, b);
  for (std::size_t i = 0; i < weir.nodes.size(); ++i) {
    expected.emplace(weir.nodes[i], weir.back_nodes[i]);
    expected.emplace(weir.back_nodes[i], weir.nodes[i]);
  }
  EXPECT_EQ(edgesOf(graph), expected);
  std::map<std::size_t, int> degrees;
  for (const auto& edge : expected) ++degrees[edge.first];
  for (std::size_t n = 0; n < graph.size(); ++n) EXPECT_EQ(graph.weights[n], std::max(1, degrees[n])) << n;
}

// Edge cuts and the work of the parts, counted from the mesh itself.
TEST(PartitionGrid, FiguresAreThoseOfTheMesh) {
  Grid grid = lakes();
  const PartitionReport report = partitionGrid(grid, {16, true, true});
  ASSERT_TRUE(report.elements && report.nodes);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> parts_at;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = grid.triangles[t][i], b = grid.triangles[t][(i + 1) % 3];
      parts_at[std::minmax(a, b)].push_back(grid.part_of[t]);
    }
  }
  std::uint64_t cut = 0, nodes_cut = 0;
  for (const auto& [edge, parts] : parts_at) {
    cut += parts.size() == 2 && parts[0] != parts[1];
    nodes_cut += grid.node_part_of[edge.first] != grid.node_part_of[edge.second];
  }
  EXPECT_EQ(report.elements->edge_cut, cut);
  EXPECT_EQ(report.nodes->edge_cut, nodes_cut);
  std::vector<std::uint64_t> sizes(16, 0);
  for (const std::uint32_t part : grid.part_of) ++sizes.at(part);
  EXPECT_EQ(report.elements->least, std::ranges::min(sizes));
  EXPECT_EQ(report.elements->most, std::ranges::max(sizes));
  EXPECT_DOUBLE_EQ(report.elements->balance,
                   16.0 * static_cast<double>(std::ranges::max(sizes)) / static_cast<double>(grid.triangles.size()));
  EXPECT_LE(report.elements->balance, kMostImbalance);
  EXPECT_LE(report.nodes->balance, kMostImbalance);
}

TEST(PartitionGrid, CountsPartsThatHangTogether) {
  Grid grid = lakes(6);
  const MeshGraph graph = elementGraph(grid);
  std::vector<std::uint32_t> by_lake;
  for (const std::uint32_t feature : grid.feature_of) by_lake.push_back(feature);
  EXPECT_EQ(figuresOf(graph, by_lake, 2).connected_parts, 2u);
  EXPECT_EQ(figuresOf(graph, by_lake, 2).edge_cut, 0u);
  by_lake.front() = 1;  // a triangle of the first lake
  EXPECT_EQ(figuresOf(graph, by_lake, 2).connected_parts, 1u);
}

TEST(PartitionGrid, IsTheSameInWhateverOrderAttemptsAreMade) {
  Grid first = lakes(), second = lakes();
  partitionGrid(first, {64, true, true});
  partitionGrid(second, {64, true, true}, testing::backwards);
  EXPECT_EQ(first.part_of, second.part_of);
  EXPECT_EQ(first.node_part_of, second.node_part_of);
}

TEST(PartitionGrid, LeavesNoPartEmptyHoweverMany) {
  Grid grid = lakes(4);
  for (const std::size_t parts :
       {std::size_t{1}, std::size_t{2}, grid.triangles.size() / 2, grid.triangles.size() - 1, grid.triangles.size()}) {
    partitionGrid(grid, {static_cast<std::uint32_t>(parts), true, false});
    EXPECT_EQ(std::set(grid.part_of.begin(), grid.part_of.end()).size(), parts);
    EXPECT_EQ(std::ranges::max(grid.part_of), parts - 1);
  }
  try {
    partitionGrid(grid, {static_cast<std::uint32_t>(grid.triangles.size() + 1), true, false});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("too few"));
  }
}

// Scotch's own program on the same graph, in the format of its manual.
TEST(PartitionGrid, CutsNoMoreThanGpart) {
  if (std::system("command -v scotch_gpart >/dev/null") != 0) GTEST_SKIP() << "scotch_gpart is not installed";
  const Grid grid = lakes(100);
  const coastmesh::testing::TemporaryFolder folder;
  for (const MeshGraph& graph : {elementGraph(grid), nodeGraph(grid)}) {
    {
      std::ofstream file(folder / "graph.grf");
      file << "0\n" << graph.size() << ' ' << graph.neighbours.size() << "\n0 001\n";
      for (std::size_t v = 0; v < graph.size(); ++v) {
        file << graph.weights[v] << ' ' << graph.first[v + 1] - graph.first[v];
        for (auto e = graph.first[v]; e < graph.first[v + 1]; ++e)
          file << ' ' << graph.neighbours[static_cast<std::size_t>(e)];
        file << '\n';
      }
    }
    const std::string command = "scotch_gpart -Cd 64 " + (folder / "graph.grf") + ' ' + (folder / "graph.map");
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::ifstream map(folder / "graph.map");
    std::size_t count = 0;
    ASSERT_TRUE(map >> count);
    ASSERT_EQ(count, graph.size());
    std::vector<std::uint32_t> theirs(count);
    for (std::size_t i = 0, vertex = 0; i < count; ++i) map >> vertex >> theirs.at(vertex);
    ASSERT_TRUE(map);
    const std::vector<std::uint32_t> ours = partitionGraph(graph, 64);
    EXPECT_LE(figuresOf(graph, ours, 64).edge_cut, figuresOf(graph, theirs, 64).edge_cut);
    EXPECT_LE(figuresOf(graph, ours, 64).balance, kMostImbalance);
  }
}

}  // namespace
}  // namespace coastmesh
