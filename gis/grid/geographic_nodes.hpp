#pragma once

#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The nodes in longitudes and latitudes of WGS 84, which formats without a CRS assume; the same bits if the grid has
// that CRS. REQUIRES: the grid's CRS is not a plane. Throws InputError if PROJ has no transformation.
std::vector<Point> geographicNodes(const Grid& grid, const ItemLoop& loop = inOrder);

// The same for formats that allow nothing else. Throws OutputError for a grid in a plane, naming `model`, whose format
// it is.
std::vector<Point> requireGeographicNodes(const Grid& grid, const std::string& path, const std::string& model,
                                          const ItemLoop& loop = inOrder);

}  // namespace coastmesh
