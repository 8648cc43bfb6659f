#pragma once

#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The nodes in longitudes and latitudes of WGS 84, which is what formats without a CRS mean; the same bits where they
// are that already. REQUIRES: the grid lies in no plane. Throws InputError if PROJ has no transformation.
std::vector<Point> geographicNodes(const Grid& grid, const ItemLoop& loop = inOrder);

// The same for formats that know nothing else. Throws OutputError for a grid in a plane; `model` is whose format it is.
std::vector<Point> requireGeographicNodes(const Grid& grid, const std::string& path, const std::string& model,
                                          const ItemLoop& loop = inOrder);

}  // namespace coastmesh
