#include "gis/remesh/grow_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using namespace coastmesh::testing;
using Flags = std::vector<std::uint8_t>;

// The triangle of a lattice that has these places, in any order.
TriId at(const TriMesh& mesh, const std::vector<Point>& places) {
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    if (std::ranges::all_of(mesh.triangles[t].v,
                            [&](VertexId v) { return std::ranges::find(places, mesh.points[v]) != places.end(); }))
      return t;
  return kNone;
}

std::ptrdiff_t countOf(const Flags& flags) { return std::ranges::count(flags, 1); }

TEST(GrowPart, ReachesTrianglesWithACommonNode) {
  const TriMesh mesh = lattice(6, 6, [](int, int) { return true; });
  Flags taken(mesh.triangles.size(), 0);
  EXPECT_EQ(countOf(reachOf(mesh, taken)), 0);
  const TriId t = at(mesh, {{2, 2}, {3, 2}, {3, 3}, {2, 3}});
  ASSERT_NE(t, kNone);
  taken[t] = 1;
  const Flags reach = reachOf(mesh, taken);
  // Six at each node, of which two at each edge are the same, and all three at the triangle itself.
  EXPECT_EQ(countOf(reach), 3 * 6 - 3 - 2);
  EXPECT_EQ(reach[t], 1);
}

TEST(GrowPart, TakesInSingleTrianglesWithinReach) {
  const TriMesh mesh = lattice(6, 6, [](int, int) { return true; });
  Flags taken(mesh.triangles.size(), 1);
  const TriId inside = at(mesh, {{2, 2}, {3, 2}, {3, 3}, {2, 3}});
  // At the boundary: with one neighbour, which stays too.
  const TriId first = at(mesh, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  taken[inside] = taken[first] = 0;
  for (const EdgeRef across : mesh.triangles[first].adj)
    if (across != kNone) taken[triOf(across)] = 0;
  const Flags nowhere(taken.size(), 0), everywhere(taken.size(), 1);
  Flags grown = taken;
  EXPECT_EQ(takeInSingle(mesh, nowhere, grown), 0u);
  EXPECT_EQ(grown, taken);
  EXPECT_EQ(takeInSingle(mesh, everywhere, grown), 1u);
  EXPECT_EQ(grown[inside], 1);
  EXPECT_EQ(grown[first], 0);
  // A triangle that is a water of its own is not beside the part.
  const TriMesh apart = lattice(3, 1, [](int i, int) { return i != 1; });
  Flags other(apart.triangles.size(), 0);
  other[0] = other[1] = 1;
  EXPECT_EQ(takeInSingle(apart, Flags(other.size(), 1), other), 0u);
}

TEST(GrowPart, TakesInTrianglesAtNodes) {
  const TriMesh mesh = lattice(6, 6, [](int, int) { return true; });
  Flags taken(mesh.triangles.size(), 0), at_nodes(mesh.points.size(), 0);
  const auto node = static_cast<std::size_t>(std::ranges::find(mesh.points, Point{3, 3}) - mesh.points.begin());
  ASSERT_LT(node, mesh.points.size());
  at_nodes[node] = 1;
  Flags reach(taken.size(), 1);
  const std::uint32_t left_out = at(mesh, {{3, 3}, {4, 3}, {4, 4}, {3, 4}});
  reach[left_out] = 0;
  const std::size_t taken_in = takeInAt(mesh, at_nodes, reach, taken);
  EXPECT_EQ(taken_in, static_cast<std::size_t>(countOf(taken)));
  EXPECT_EQ(taken[left_out], 0);
  for (TriId t = 0; t < taken.size(); ++t)
    EXPECT_EQ(taken[t] != 0, t != left_out && std::ranges::count(mesh.triangles[t].v, node) == 1);
  EXPECT_EQ(takeInAt(mesh, at_nodes, reach, taken), 0u);
}

}  // namespace
}  // namespace coastmesh
