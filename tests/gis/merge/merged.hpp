#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "core/quality.hpp"
#include "gis/check/triangle_overlaps.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/merge/merge_grids.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh::testing {

// Squares of a length, two triangles each, where `wanted`, turned around a place; its boundaries are of one role.
struct Squares {
  int columns = 10, rows = 10;
  double length = 1.0;
  Point corner{};     // before turning
  double turn = 0.0;  // radians, around the corner
  std::function<bool(int, int)> wanted = [](int, int) { return true; };
};

inline Grid gridOf(const Squares& squares, BoundaryRole role = BoundaryRole::Land) {
  const TriMesh mesh = lattice(squares.columns, squares.rows, squares.wanted);
  Grid grid;
  const double c = squares.length * std::cos(squares.turn), s = squares.length * std::sin(squares.turn);
  for (const Point& p : mesh.points)
    grid.nodes.push_back({squares.corner.x + c * p.x - s * p.y, squares.corner.y + s * p.x + c * p.y});
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  for (const Point& p : grid.nodes) grid.z.push_back(-10.0 - 0.25 * p.x + 0.125 * p.y);
  grid.boundaries = findBoundaries(mesh);
  if (role == BoundaryRole::Open) grid.boundaries.front().role = role;
  removeUnusedNodes(grid);
  return grid;
}

// Gives the edges of a grid's boundary for which `is_open` an open boundary, and all others shores.
inline void openWhere(Grid& grid, const std::function<bool(const Point& middle)>& is_open) {
  const TriMesh mesh = linkGrid(grid).mesh;
  std::vector<std::vector<VertexId>> loops = boundaryLoops(mesh);
  grid.boundaries = cutLoops(grid, loops, [&](std::uint32_t a, std::uint32_t b) {
    return BoundaryKind{is_open(midpoint(grid.nodes[a], grid.nodes[b])) ? BoundaryRole::Open : BoundaryRole::Land};
  });
}

inline double areaOf(const Grid& grid) {
  double area = 0.0;
  for (const GridCorners& v : grid.triangles) area += signedArea(grid.nodes[v[0]], grid.nodes[v[1]], grid.nodes[v[2]]);
  return area;
}

// The corners of triangles, from the least place on.
inline std::multiset<std::array<double, 6>> trianglesOf(const Grid& grid) {
  std::multiset<std::array<double, 6>> all;
  for (const GridCorners& v : grid.triangles) {
    unsigned first = 0;
    for (unsigned i = 1; i < 3; ++i) {
      const Point &p = grid.nodes[v[i]], &q = grid.nodes[v[first]];
      if (p.x < q.x || (p.x == q.x && p.y < q.y)) first = i;
    }
    const Point &a = grid.nodes[v[first]], &b = grid.nodes[v[(first + 1) % 3]], &c = grid.nodes[v[(first + 2) % 3]];
    all.insert({a.x, a.y, b.x, b.y, c.x, c.y});
  }
  return all;
}

// The edges on boundaries of a role, by their places.
inline std::set<std::array<double, 4>> edgesOfRole(const Grid& grid, std::set<BoundaryRole> roles) {
  std::set<std::array<double, 4>> edges;
  for (const Boundary& boundary : grid.boundaries)
    if (roles.contains(boundary.role))
      for (const auto& [a, b] : edgesOf(boundary))
        edges.insert({grid.nodes[a].x, grid.nodes[a].y, grid.nodes[b].x, grid.nodes[b].y});
  return edges;
}
inline std::set<std::array<double, 4>> shoresOf(const Grid& grid) {
  return edgesOfRole(grid, {BoundaryRole::Land, BoundaryRole::Island});
}
inline std::set<std::array<double, 4>> openOf(const Grid& grid) { return edgesOfRole(grid, {BoundaryRole::Open}); }

// What has to hold for every merged grid: it is consistent and conforming, no triangle is inverted or on top of
// another, no node is pinched, each edge where the mesh ends is in one boundary, all of the inserted mesh is there, and
// sources are right.
inline void expectMerged(const Grid& grid, const Grid& inserted, const Grid& merged,
                         const std::vector<MergeSource>& nodes, const std::vector<MergeSource>& triangles) {
  requireConsistent(merged);
  const LinkedGrid linked = linkGrid(merged);
  EXPECT_TRUE(linked.conflicts.empty());
  for (const GridCorners& v : merged.triangles)
    EXPECT_GT(signedArea(merged.nodes[v[0]], merged.nodes[v[1]], merged.nodes[v[2]]), 0.0);
  EXPECT_TRUE(triangleOverlaps(merged, linked.mesh).empty());
  std::map<VertexId, int> passes;
  std::size_t ends = 0;
  for (const std::vector<VertexId>& loop : boundaryLoops(linked.mesh)) {
    ends += loop.size();
    for (const VertexId v : loop)
      EXPECT_EQ(++passes[v], 1) << "pinched at " << merged.nodes[v].x << " " << merged.nodes[v].y;
  }
  std::set<NodePair> listed;
  for (const Boundary& boundary : merged.boundaries)
    for (const auto& [a, b] : edgesOf(boundary)) {
      EXPECT_TRUE(listed.insert({a, b}).second) << "in two boundaries";
    }
  EXPECT_EQ(listed.size(), ends);
  ASSERT_EQ(nodes.size(), merged.nodes.size());
  ASSERT_EQ(triangles.size(), merged.triangles.size());
  std::vector<bool> there(inserted.triangles.size(), false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (triangles[t].mesh == kNone) continue;
    const Grid& source = triangles[t].mesh == 0 ? grid : inserted;
    if (triangles[t].mesh == 1) there[triangles[t].number] = true;
    for (unsigned i = 0; i < 3; ++i) {
      const Point &now = merged.nodes[merged.triangles[t][i]],
                  &then = source.nodes[source.triangles[triangles[t].number][i]];
      // Nodes of the grid may have become nodes of the other mesh.
      if (triangles[t].mesh == 1) {
        EXPECT_EQ(now, then);
      } else {
        EXPECT_NEAR(distance(now, then), 0.0, 0.02);
      }
    }
  }
  EXPECT_EQ(std::count(there.begin(), there.end(), false), 0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].mesh == kNone) continue;
    const Grid& source = nodes[n].mesh == 0 ? grid : inserted;
    EXPECT_EQ(merged.nodes[n], source.nodes[nodes[n].number]);
    if (!source.z.empty()) {
      EXPECT_EQ(merged.z[n], source.z[nodes[n].number]);
    }
  }
}

}  // namespace coastmesh::testing
