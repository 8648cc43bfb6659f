#include "gis/merge/nearby_shore.hpp"

#include <algorithm>

#include "gis/geometry/chain_index.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/boundary_kinds.hpp"

namespace coastmesh {

NearbyShore::NearbyShore(const Grid& grid, const ItemLoop& loop) {
  std::vector<Box> boxes;
  for (const Boundary& boundary : grid.boundaries) {
    const bool is_opening = isOpening({boundary.role, boundary.ibtype});
    for (const auto& [from, to] : edgesOf(boundary)) {
      const Edge& edge = edges_.emplace_back(grid.nodes[from], grid.nodes[to], is_opening);
      boxes.push_back(Box::of(edge.a, edge.b));
      longest_ = std::max(longest_, distance(edge.a, edge.b));
    }
  }
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
}

bool NearbyShore::passes(const Point& a, const Point& b) const {
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
