#include "gis/check/node_meets.hpp"

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
  std::vector<PlacedNode> nodes;
  reserveOn(loop, nodes, grid.nodes.size());
  nodes.resize(grid.nodes.size());
  forEachByStretches(loop, nodes.size(), [&](std::size_t i) {
    nodes[i] = {grid.nodes[i], static_cast<std::uint32_t>(i)};
  });
  sortOn(loop, nodes);
  return joined(overStretches(loop, nodes.size(), [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> found;
    for (std::size_t i = std::max<std::size_t>(first, 1); i < last; ++i)
      if (nodes[i].place == nodes[i - 1].place) found.push_back(nodes[i].node);
    return found;
  }));
}

std::vector<std::uint32_t> hangingNodes(const Grid& grid, const TriMesh& mesh, const ItemLoop& loop) {
  constexpr double kOnEdge = 1e-7;  // share of the edge's length
  const std::vector<NodePair> edges =
      joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<NodePair> some;
        for (auto t = static_cast<TriId>(first); t < last; ++t)
          for (unsigned i = 0; i < 3; ++i)
            if (mesh.triangles[t].adj[i] == kNone)
              some.push_back({mesh.origin(edgeRef(t, i)), mesh.target(edgeRef(t, i))});
        return some;
      }));
  std::vector<Box> boxes(edges.size());
  std::vector<std::uint32_t> nodes(edges.size());
  forEachByStretches(loop, edges.size(), [&](std::size_t e) {
    boxes[e] = Box::of(grid.nodes[edges[e][0]], grid.nodes[edges[e][1]]);
    nodes[e] = edges[e][0];
  });
  const BoxTree tree(boxes, BoxTree::Order::Hilbert, loop);
  sortOn(loop, nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
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
