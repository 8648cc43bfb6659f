#include "gis/model/node_meets.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gis/geometry/box_tree.hpp"
#include "gis/grid/boundary_kinds.hpp"

namespace coastmesh {

std::vector<std::uint32_t> repeatedNodes(const Grid& grid) {
  std::vector<std::uint32_t> order(grid.nodes.size()), found;
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order,
                           [&](std::uint32_t a, std::uint32_t b) { return lexLess(grid.nodes[a], grid.nodes[b]); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (grid.nodes[order[i]] == grid.nodes[order[i - 1]]) found.push_back(order[i]);
  return found;
}

std::vector<std::uint32_t> hangingNodes(const Grid& grid, const TriMesh& mesh) {
  constexpr double kOnEdge = 1e-7;  // share of the edge's length
  std::vector<NodePair> edges;
  std::vector<Box> boxes;
  std::vector<std::uint32_t> nodes, found;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh.triangles[t].adj[i] != kNone) continue;
      const std::uint32_t a = mesh.origin(edgeRef(t, i)), b = mesh.target(edgeRef(t, i));
      edges.push_back({a, b});
      boxes.push_back(Box::of(grid.nodes[a], grid.nodes[b]));
      nodes.push_back(a);
    }
  }
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::ranges::sort(nodes);
  const auto repeated = std::ranges::unique(nodes);
  nodes.erase(repeated.begin(), repeated.end());
  for (const std::uint32_t node : nodes) {
    const Point& p = grid.nodes[node];
    bool hangs = false;
    tree.visit(Box::of(p, p), [&](std::uint32_t e) {
      const Point &a = grid.nodes[edges[e][0]], &b = grid.nodes[edges[e][1]];
      if (edges[e][0] == node || edges[e][1] == node || p == a || p == b) return;
      const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
      if (grid.crs.geographic && std::abs(dx) > 180) return;  // across the antimeridian, not around the globe
      const double off = std::abs(dx * (p.y - a.y) - dy * (p.x - a.x)) / square;
      const double along = (dx * (p.x - a.x) + dy * (p.y - a.y)) / square;
      hangs = hangs || (off < kOnEdge && along > 0.0 && along < 1.0);
    });
    if (hangs) found.push_back(node);
  }
  return found;
}

}  // namespace coastmesh
