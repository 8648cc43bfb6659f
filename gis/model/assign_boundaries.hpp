#pragma once

#include "gis/grid/grid.hpp"
#include "gis/model/boundary_edges.hpp"

namespace coastmesh {

// Changes the grid's boundaries according to the options. Throws InputError.
BoundaryReport assignBoundaries(Grid& grid, const BoundaryOptions& options, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
