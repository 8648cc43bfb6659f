#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/grid.hpp"
#include "gis/rivers/river_plane.hpp"

namespace coastmesh {

// The water of a mesh, near some places, in a working plane.
class MeshWater {
 public:
  // `near`: a box in the mesh's CRS. REQUIRES: the arguments outlive it.
  MeshWater(const Grid& grid, const RiverPlane& plane, const Box& near, const ItemLoop& loop = inOrder);

  bool holds(const Point& plane) const { return triangleAt(plane_.inverse(plane)).has_value(); }
  // Linear between nodes; NaN outside the mesh, and if it has no depths there.
  double zAt(const Point& plane) const;
  // The nearest place of the mesh that is at most `reach` away, in plane units.
  std::optional<Point> nearest(const Point& plane, double reach) const;

 private:
  std::optional<std::uint32_t> triangleAt(const Point& place) const;

  const Grid& grid_;
  const RiverPlane& plane_;
  std::vector<std::uint32_t> triangles_;
  BoxTree tree_;  // of `triangles_`
};

}  // namespace coastmesh
