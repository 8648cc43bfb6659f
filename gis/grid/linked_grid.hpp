#pragma once

#include <vector>

#include "core/bulk_list.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The triangles of a grid, in its CRS, with links to their neighbours.
struct LinkedGrid {
  TriMesh mesh;
  std::vector<EdgeConflict> conflicts;  // edges that cannot be linked; `mesh` has a boundary there
};

// Links the triangles of `grid`; its nodes stay in its CRS. `loop` may use threads: the links are the same.
inline LinkedGrid linkGrid(const Grid& grid, const ItemLoop& loop = inOrder) {
  LinkedGrid linked;
  linked.mesh = linkTriangles(copyOn(loop, grid.nodes), grid.triangles, linked.conflicts, loop);
  return linked;
}

}  // namespace coastmesh
