#pragma once

#include <cstdint>
#include <vector>

#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Nodes where triangles meet and do not hang together. Coordinates are compared as they are.

// Nodes at the place of another one: all but one of those there, in the order of places.
std::vector<std::uint32_t> repeatedNodes(const Grid& grid);

// Nodes of the boundary that lie on one of its edges without being an end of it, ascending. `mesh` is the grid's, from
// `linkTriangles`.
std::vector<std::uint32_t> hangingNodes(const Grid& grid, const TriMesh& mesh);

}  // namespace coastmesh
