#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Nodes where triangles touch without being connected. Coordinates are compared unchanged.

// Nodes at the place of another one: all but the first at each place, ordered by place.
std::vector<std::uint32_t> repeatedNodes(const Grid& grid, const ItemLoop& loop = inOrder);

// Nodes of the boundary that lie on one of its edges without being an end of it, ascending. `mesh` is the grid's, from
// `linkTriangles`.
std::vector<std::uint32_t> hangingNodes(const Grid& grid, const TriMesh& mesh, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
