#pragma once

#include <cstddef>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Gives nodes whose z is unknown the mean of their neighbours' where any is known, from the known ones outwards, one
// ring after another. Returns how many were filled; pieces of the mesh without a known node stay as they are.
std::size_t fillFromNeighbours(Grid& grid);

// Gives them the z of the known node that is nearest along the mesh's edges.
std::size_t fillFromNearest(Grid& grid);

}  // namespace coastmesh
