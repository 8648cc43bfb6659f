#include "gis/grid/boundary_chains.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::lattice;

std::vector<std::array<std::uint32_t, 3>> cornersOf(const TriMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (const Triangle& t : mesh.triangles) corners.push_back(t.v);
  return corners;
}

TEST(ChainEdges, JoinsEdgesInAnyOrder) {
  const std::vector<NodePair> edges{{7, 8}, {2, 3}, {8, 7}, {1, 2}, {3, 4}};
  const auto chains = chainEdges(edges);
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_FALSE(chains[0].closed);
  EXPECT_THAT(chains[0].nodes, ElementsAre(1, 2, 3, 4));
  EXPECT_TRUE(chains[1].closed);
  EXPECT_THAT(chains[1].nodes, ElementsAre(7, 8));
}

TEST(ChainEdges, KeepsALoopTogetherThatPassesItsStartTwice) {
  const std::vector<NodePair> edges{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}};
  const auto chains = chainEdges(edges);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_TRUE(chains[0].closed);
  EXPECT_THAT(chains[0].nodes, ElementsAre(0, 1, 2, 0, 3, 4));
}

TEST(ChainEdges, UsesEveryEdgeOnce) {
  std::mt19937 random(3);
  std::vector<NodePair> edges;
  for (int i = 0; i < 300; ++i)
    edges.push_back({static_cast<std::uint32_t>(random() % 40), static_cast<std::uint32_t>(random() % 40)});
  std::vector<NodePair> used;
  for (const Boundary& chain : chainEdges(edges)) {
    const auto some = edgesOf(chain);
    used.insert(used.end(), some.begin(), some.end());
    if (chain.closed && chain.nodes.size() == 1) used.push_back({chain.nodes[0], chain.nodes[0]});
  }
  std::ranges::sort(edges);
  std::ranges::sort(used);
  EXPECT_EQ(used, edges);
  EXPECT_THAT(chainEdges({}), IsEmpty());
}

TEST(KeepBoundaryEdges, TurnsThemAndDropsTheOthers) {
  const TriMesh mesh = lattice(2, 1, [](int, int) { return true; });  // points 0 1 2 below, 3 4 5 above
  // Along the boundary, against it, between two triangles, and not an edge.
  std::vector<std::vector<NodePair>> groups{{{0, 1}, {2, 1}, {1, 4}, {0, 5}}, {{3, 0}, {3, 4}}, {}};
  keepBoundaryEdges(cornersOf(mesh), groups);
  EXPECT_THAT(groups[0], ElementsAre(NodePair{0, 1}, NodePair{1, 2}));
  EXPECT_THAT(groups[1], ElementsAre(NodePair{3, 0}, NodePair{4, 3}));
  EXPECT_THAT(groups[2], IsEmpty());
}

// The outer shore of a mesh whose longitudes jump at ±180, and its island.
TEST(FindMissingBoundaries, TellsShoresFromIslandsAcrossTheAntimeridian) {
  const TriMesh mesh = lattice(
      5, 5, [](int i, int j) { return i != 2 || j != 2; },
      [](int i, int j) {
        const double x = 179.5 + 0.2 * i;
        return Point{x > 180.0 ? x - 360.0 : x, 0.2 * j};
      });
  Grid grid;
  grid.crs = parseCrs("EPSG:4326");
  grid.nodes = mesh.points;
  const auto corners = cornersOf(mesh);
  grid.triangles.assign(corners.begin(), corners.end());
  findMissingBoundaries(grid);
  ASSERT_EQ(grid.boundaries.size(), 2u);
  for (const Boundary& boundary : grid.boundaries)
    EXPECT_EQ(boundary.role, boundary.nodes.size() > 10 ? BoundaryRole::Land : BoundaryRole::Island);
}

}  // namespace
}  // namespace coastmesh
