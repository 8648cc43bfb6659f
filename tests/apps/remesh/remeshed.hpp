#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "apps/remesh/remesh_grid.hpp"
#include "core/quality.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/linked_grid.hpp"

namespace coastmesh::testing {

using Flags = std::vector<std::uint8_t>;

// Flags of the triangles whose middle is in the box.
inline Flags middlesInBox(const Grid& grid, double west, double south, double east, double north) {
  Flags taken;
  for (const GridCorners& v : grid.triangles) {
    const Point p = (1.0 / 3.0) * (grid.nodes[v[0]] + grid.nodes[v[1]] + grid.nodes[v[2]]);
    taken.push_back(west <= p.x && p.x <= east && south <= p.y && p.y <= north ? 1 : 0);
  }
  return taken;
}

inline RemeshOptions ofSize(double size) {
  RemeshOptions options;
  options.sizes.size_m = size;
  return options;
}

// How many triangles each directed edge has.
inline std::map<NodePair, int> edgeCounts(const Grid& grid) {
  std::map<NodePair, int> counts;
  for (const GridCorners& v : grid.triangles)
    for (unsigned i = 0; i < 3; ++i) ++counts[{v[i], v[(i + 1) % 3]}];
  return counts;
}

inline double planeArea(const Grid& grid) {
  double area = 0.0;
  for (const GridCorners& v : grid.triangles) area += signedArea(grid.nodes[v[0]], grid.nodes[v[1]], grid.nodes[v[2]]);
  return area;
}

// The chain without new nodes, in the numbers before. Each new node must be on the straight edge between the nodes
// around it, in turn.
inline std::vector<std::uint32_t> oldNodes(const std::vector<std::uint32_t>& chain, bool closed, const Grid& grid,
                                           const RemeshReport& report) {
  std::vector<std::uint32_t> old;
  const std::vector<std::uint32_t>& sources = report.replaced.nodes;
  std::uint32_t from = kNone;
  double along = 0.0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (sources[chain[i]] != kNone) {
      old.push_back(sources[chain[i]]);
      from = chain[i];
      along = 0.0;
      continue;
    }
    EXPECT_NE(from, kNone) << "a chain begins with a new node";
    std::size_t next = i;
    while (next < chain.size() && sources[chain[next]] == kNone) ++next;
    EXPECT_TRUE(next < chain.size() || closed) << "a chain ends with a new node";
    const Point a = grid.nodes[from], b = grid.nodes[next < chain.size() ? chain[next] : chain.front()],
                p = grid.nodes[chain[i]];
    const double length = distance(a, b), share = dot(p - a, b - a) / (length * length);
    EXPECT_GT(share, along);
    EXPECT_LT(share, 1.0);
    EXPECT_LT(std::abs(cross(b - a, p - a)) / length, 1e-9 * length);
    along = share;
  }
  return old;
}

inline std::set<NodePair> undirected(const std::vector<std::uint32_t>& nodes, bool closed) {
  std::set<NodePair> edges;
  const std::size_t n = nodes.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i)
    edges.insert({std::min(nodes[i], nodes[(i + 1) % n]), std::max(nodes[i], nodes[(i + 1) % n])});
  return edges;
}

// All that has to hold for a grid in a plane, of which the triangles with a flag were meshed anew: what stays is as
// before, bit for bit, the mesh is conforming and as large as before, boundaries and lines are the same with further
// nodes on their edges.
inline void expectRemeshed(const Grid& before, const Flags& taken, const Grid& after, const RemeshReport& report) {
  const ReplaceReport& replaced = report.replaced;
  ASSERT_EQ(replaced.nodes.size(), after.nodes.size());
  ASSERT_EQ(replaced.triangles.size(), after.triangles.size());
  requireConsistent(after);
  // Nodes and triangles that stay.
  std::uint32_t last = 0;
  std::size_t kept_nodes = 0;
  for (std::size_t n = 0; n < after.nodes.size(); ++n) {
    const std::uint32_t source = replaced.nodes[n];
    if (source == kNone) continue;
    EXPECT_TRUE(kept_nodes++ == 0 || source > last) << "another order";
    last = source;
    EXPECT_EQ(after.nodes[n], before.nodes[source]);
    if (!before.z.empty()) {
      EXPECT_EQ(after.z[n], before.z[source]);
    }
    if (!before.size_m.empty()) {
      EXPECT_EQ(after.size_m[n], before.size_m[source]);
    }
    if (replaced.nodes_added >= replaced.nodes_removed) {
      EXPECT_EQ(source, n) << "another number";
    }
  }
  EXPECT_EQ(kept_nodes, before.nodes.size() - replaced.nodes_removed);
  std::vector<bool> stays(before.triangles.size(), false);
  std::size_t kept_triangles = 0;
  for (std::size_t t = 0; t < after.triangles.size(); ++t) {
    const std::uint32_t source = replaced.triangles[t];
    if (source == kNone) continue;
    EXPECT_TRUE(kept_triangles++ == 0 || source > last) << "another order";
    last = source;
    stays[source] = true;
    for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(replaced.nodes[after.triangles[t][i]], before.triangles[source][i]);
    if (!before.feature_of.empty()) {
      EXPECT_EQ(after.feature_of[t], before.feature_of[source]);
    }
    if (!before.area_m2.empty()) {
      EXPECT_EQ(after.area_m2[t], before.area_m2[source]);
    }
  }
  // Others without a flag touch one with a flag, and are counted.
  std::set<std::uint32_t> flagged_nodes;
  std::size_t flagged = 0, others = 0;
  for (std::size_t t = 0; t < taken.size(); ++t) {
    if (taken[t] == 0) continue;
    ++flagged;
    flagged_nodes.insert(before.triangles[t].begin(), before.triangles[t].end());
  }
  for (std::size_t t = 0; t < taken.size(); ++t) {
    if (taken[t] != 0 || stays[t]) continue;
    ++others;
    EXPECT_TRUE(std::ranges::any_of(before.triangles[t], [&](std::uint32_t n) { return flagged_nodes.contains(n); }));
  }
  EXPECT_LE(others, report.taken_in);
  EXPECT_EQ(replaced.triangles_removed + report.tidied.loose + report.tidied.teeth, flagged + report.taken_in);
  EXPECT_EQ(kept_triangles, before.triangles.size() - replaced.triangles_removed);
  // The mesh.
  for (const GridCorners& v : after.triangles)
    EXPECT_GT(signedArea(after.nodes[v[0]], after.nodes[v[1]], after.nodes[v[2]]), 0.0);
  for (const auto& [edge, count] : edgeCounts(after)) EXPECT_EQ(count, 1) << edge[0] << " " << edge[1];
  EXPECT_NEAR(planeArea(after), planeArea(before), 1e-9 * planeArea(before));
  // Each feature as large as before.
  if (!before.feature_of.empty()) {
    std::map<std::uint32_t, double> more;
    for (std::size_t t = 0; t < after.triangles.size(); ++t) more[after.feature_of[t]] += after.area_m2[t];
    for (std::size_t t = 0; t < before.triangles.size(); ++t) more[before.feature_of[t]] -= before.area_m2[t];
    for (const auto& [feature, area] : more) EXPECT_NEAR(area, 0.0, 1e-9 * planeArea(before)) << feature;
  }
  // Boundaries and lines.
  ASSERT_EQ(after.boundaries.size(), before.boundaries.size());
  for (std::size_t i = 0; i < after.boundaries.size(); ++i) {
    const Boundary &now = after.boundaries[i], &then = before.boundaries[i];
    EXPECT_EQ(now.role, then.role);
    EXPECT_EQ(now.closed, then.closed);
    EXPECT_EQ(now.ibtype, then.ibtype);
    EXPECT_EQ(now.weir, then.weir);
    EXPECT_EQ(now.back_nodes.size(), then.back_nodes.size());
    EXPECT_EQ(oldNodes(now.nodes, now.closed, after, report), then.nodes);
    EXPECT_EQ(oldNodes(now.back_nodes, now.closed, after, report), then.back_nodes);
  }
  ASSERT_EQ(after.lines.size(), before.lines.size());
  for (std::size_t i = 0; i < after.lines.size(); ++i) {
    EXPECT_EQ(after.lines[i].kind, before.lines[i].kind);
    EXPECT_EQ(after.lines[i].name, before.lines[i].name);
    EXPECT_EQ(oldNodes(after.lines[i].nodes, after.lines[i].closed, after, report), before.lines[i].nodes);
  }
  // Where the mesh ends, it ends along boundaries, if it did so before.
  const auto looseEnds = [](const Grid& grid) {
    std::set<NodePair> on_boundary;
    for (const Boundary& boundary : grid.boundaries) {
      on_boundary.merge(undirected(boundary.nodes, boundary.closed));
      on_boundary.merge(undirected(boundary.back_nodes, boundary.closed));
    }
    const std::map<NodePair, int> counts = edgeCounts(grid);
    return std::ranges::count_if(counts, [&](const auto& entry) {
      const auto [a, b] = entry.first;
      return !counts.contains({b, a}) && !on_boundary.contains({std::min(a, b), std::max(a, b)});
    });
  };
  EXPECT_EQ(looseEnds(after), looseEnds(before));
}

}  // namespace coastmesh::testing
