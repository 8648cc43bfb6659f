#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The boundary of a grid, as it was.
class NearbyShore {
 public:
  explicit NearbyShore(const Grid& grid, const ItemLoop& loop = inOrder);

  // True if an edge is closer to a shore than the longer of both is, and not to an open boundary or a river: the coast
  // passes there.
  bool passes(const Point& a, const Point& b) const;

 private:
  struct Edge {
    Point a, b;
    bool is_opening = false;
  };
  std::vector<Edge> edges_;
  double longest_ = 0.0;
  BoxTree tree_;
};

}  // namespace coastmesh
