#include "gis/merge/outline.hpp"

#include <algorithm>
#include <limits>

#include "core/predicates.hpp"
#include "gis/geometry/ring_area.hpp"
#include "gis/grid/boundary_kinds.hpp"

namespace coastmesh {

Outline::Outline(const Grid& grid, const TriMesh& mesh, const ItemLoop& loop) : grid_(grid) {
  const EdgeKinds kinds(grid);
  for (const std::vector<VertexId>& ring : boundaryLoops(mesh, loop)) {
    std::vector<Point> places;
    std::vector<Edge> edges;
    bool is_open = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const VertexId a = ring[i], b = ring[(i + 1) % ring.size()];
      places.push_back(grid.nodes[a]);
      edges.push_back({a, b, kinds.isOpen(a, b)});
      is_open = is_open || edges.back().joins;
    }
    has_open_ = has_open_ || is_open;
    if (is_open || signedAreaOf(places) > 0.0) edges_.insert(edges_.end(), edges.begin(), edges.end());
  }
  std::vector<Box> boxes;
  for (Edge& edge : edges_) {
    if (!has_open_) edge.joins = true;
    boxes.push_back(Box::of(place(edge.a), place(edge.b)));
    box_.add(boxes.back());
    longest_ = std::max(longest_, distance(place(edge.a), place(edge.b)));
  }
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
}

void Outline::join(std::span<const std::uint32_t> edges) {
  for (const std::uint32_t e : edges) edges_[e].joins = true;
}

bool Outline::surrounds(const Point& p) const {
  int turns = 0;  // of the outline around the place
  visit({p.x, p.y, std::numeric_limits<double>::infinity(), p.y}, [&](std::uint32_t e) {
    const Point &a = place(edges_[e].a), &b = place(edges_[e].b);
    if (a.y <= p.y && b.y > p.y && orient2d(a, b, p) > 0) ++turns;
    if (a.y > p.y && b.y <= p.y && orient2d(a, b, p) < 0) --turns;
  });
  return turns != 0;
}

bool Outline::passes(const Point& p) const {
  bool found = false;
  visit(Box::of(p, p), [&](std::uint32_t e) {
    const Point &a = place(edges_[e].a), &b = place(edges_[e].b);
    found = found || (Box::of(a, b).meets(Box::of(p, p)) && orient2d(a, b, p) == 0);
  });
  return found;
}

}  // namespace coastmesh
