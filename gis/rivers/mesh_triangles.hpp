#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Finds triangles of a mesh by place, in the mesh's CRS.
class MeshTriangles {
 public:
  // Those whose boxes meet `near`. REQUIRES: the grid outlives it.
  MeshTriangles(const Grid& grid, const Box& near, const ItemLoop& loop = inOrder);

  // The one that contains the place; of several, the first.
  std::optional<std::uint32_t> at(const Point& place) const;
  // Linear between nodes; NaN outside the triangles, and if the mesh has no depths there.
  double zAt(const Point& place) const { return valueAt(grid_.z, place); }
  // The same for any values of its nodes, or none.
  double valueAt(const std::vector<double>& values, const Point& place) const;

  // Edges that only one of these triangles has, by their nodes.
  std::vector<NodePair> boundaryEdges() const;

  // Calls `found(t)` for each triangle whose box meets `query`.
  template <typename Found>
  void visit(const Box& query, const Found& found) const {
    tree_.visit(query, [&](std::uint32_t i) { found(triangles_[i]); });
  }

 private:
  const Grid& grid_;
  std::vector<std::uint32_t> triangles_;
  BoxTree tree_;  // of `triangles_`
};

}  // namespace coastmesh
