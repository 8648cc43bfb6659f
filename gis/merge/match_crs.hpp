#pragma once

#include <string>

#include "gis/crs/crs.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Brings a grid's nodes to the CRS of `beside`; they keep their bits if it is the same. Longitudes are then in the turn
// in which the grid is nearest to it. Throws InputError if one of the two is a plane and the other is not, and for
// nodes without a place in that CRS, with `path`.
void matchCrs(Grid& grid, const Grid& beside, const std::string& path);

}  // namespace coastmesh
