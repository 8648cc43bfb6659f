#include "gis/model/node_meets.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "gis/geometry/box_tree.hpp"
#include "gis/grid/boundary_kinds.hpp"

namespace coastmesh {

namespace {

struct PlacedNode {
  Point place;
  std::uint32_t node;

  bool operator<(const PlacedNode& other) const {
    return place == other.place ? node < other.node : lexLess(place, other.place);
  }
};

}  // namespace

std::vector<std::uint32_t> repeatedNodes(const Grid& grid, const ItemLoop& loop) {
  std::vector<PlacedNode> nodes(grid.nodes.size());
  forEachByStretches(loop, nodes.size(), [&](std::size_t i) {
    nodes[i] = {grid.nodes[i], static_cast<std::uint32_t>(i)};
  });
  sortOn(loop, nodes);
  std::vector<std::uint32_t> found;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (nodes[i].place == nodes[i - 1].place) found.push_back(nodes[i].node);
  return found;
}

std::vector<std::uint32_t> hangingNodes(const Grid& grid, const TriMesh& mesh, const ItemLoop& loop) {
  constexpr double kOnEdge = 1e-7;  // share of the edge's length
  std::vector<NodePair> edges;
  std::vector<Box> boxes;
  std::vector<std::uint32_t> nodes;
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
  const auto isHanging = [&](std::uint32_t node) {
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
    return hangs;
  };
  return joined(overStretches(
      loop, nodes.size(),
      [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> found;
        std::ranges::copy_if(std::span(nodes).subspan(first, last - first), std::back_inserter(found), isHanging);
        return found;
      },
      1024));
}

}  // namespace coastmesh
