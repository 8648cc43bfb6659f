#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/nest_plane.hpp"

namespace coastmesh {

// The boundary of a grid, as it was. REQUIRES: the plane outlives it.
class NearbyShore {
 public:
  // In `plane` if that is not null; without what is on the other side of the Earth there.
  explicit NearbyShore(const Grid& grid, const NestPlane* plane = nullptr, const ItemLoop& loop = inOrder);

  // True if an edge is closer to a shore than the longer of both is, and not to an open boundary or a river: the coast
  // passes there.
  bool passes(const Point& from, const Point& to) const;

 private:
  struct Edge {
    Point a, b;
    bool is_opening = false;
  };
  Point at(const Point& node) const { return plane_ == nullptr ? node : plane_->forward(node); }

  const NestPlane* plane_;
  std::vector<Edge> edges_;
  double longest_ = 0.0;
  BoxTree tree_;
};

}  // namespace coastmesh
