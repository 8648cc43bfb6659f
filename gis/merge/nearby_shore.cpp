#include "gis/merge/nearby_shore.hpp"

#include <algorithm>

#include "gis/geometry/chain_index.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/boundary_kinds.hpp"

namespace coastmesh {

NearbyShore::NearbyShore(const Grid& grid, const NestPlane* plane, const ItemLoop& loop) : plane_(plane) {
  std::vector<Box> boxes;
  for (const Boundary& boundary : grid.boundaries) {
    const bool is_opening = isOpening({boundary.role, boundary.ibtype});
    for (const auto& [from, to] : edgesOf(boundary)) {
      const Point a = at(grid.nodes[from]), b = at(grid.nodes[to]);
      if (plane != nullptr && plane->isFar(a) && plane->isFar(b)) continue;
      const Edge& edge = edges_.emplace_back(a, b, is_opening);
      boxes.push_back(Box::of(edge.a, edge.b));
      longest_ = std::max(longest_, distance(edge.a, edge.b));
    }
  }
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
}

bool NearbyShore::passes(const Point& from, const Point& to) const {
  const Point a = at(from), b = at(to);
  const Point middle = midpoint(a, b);
  const double own = squaredDistance(a, b);
  bool is_at_shore = false, is_at_opening = false;
  tree_.visit(Box::of(a, b).grownBy(std::max(longest_, distance(a, b))), [&](std::uint32_t e) {
    const Edge& edge = edges_[e];
    if (squaredDistanceToSegment(middle, edge.a, edge.b) > std::max(own, squaredDistance(edge.a, edge.b))) return;
    (edge.is_opening ? is_at_opening : is_at_shore) = true;
  });
  return is_at_shore && !is_at_opening;
}

}  // namespace coastmesh
