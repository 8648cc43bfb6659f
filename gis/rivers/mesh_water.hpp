#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/grid.hpp"
#include "gis/rivers/mesh_triangles.hpp"
#include "gis/rivers/river_plane.hpp"

namespace coastmesh {

// The place of a mesh that is nearest to another one.
struct NearWater {
  Point place;
  double distance = 0.0;
  double edge = 0.0;  // length of the mesh's edge there
  Point inside;       // the middle of the triangle there
};

// The water of a mesh, near some places, in a working plane.
class MeshWater {
 public:
  // `near`: a box in the mesh's CRS. REQUIRES: the arguments outlive it.
  MeshWater(const Grid& grid, const RiverPlane& plane, const Box& near, const ItemLoop& loop = inOrder);

  bool holds(const Point& plane) const { return triangles_.at(plane_.inverse(plane)).has_value(); }
  // Linear between nodes; NaN outside the mesh, and if it has no depths there.
  double zAt(const Point& plane) const { return triangles_.zAt(plane_.inverse(plane)); }
  // True on the land of a flood plain; of a mesh without its attribute, above the zero of depths.
  bool isLandAt(const Point& plane) const;
  // Edges of the mesh's boundary.
  std::vector<std::pair<Point, Point>> shores() const;
  // The nearest place of the mesh that is at most `reach` away, in plane units.
  std::optional<NearWater> nearest(const Point& plane, double reach) const;

 private:
  const Grid& grid_;
  const RiverPlane& plane_;
  MeshTriangles triangles_;
  std::vector<double> land_;  // of each node, above 0 on land; empty: by its depth
};

}  // namespace coastmesh
