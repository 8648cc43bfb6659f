#pragma once

#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The nodes in longitudes and latitudes on the ellipsoid of the grid's CRS; the same bits where they are that already.
// REQUIRES: the grid lies in no plane.
std::vector<Point> geographicNodes(const Grid& grid, const ItemLoop& loop = inOrder);

// The same for formats that know nothing else. Throws OutputError for a grid in a plane; `model` is whose format it is.
std::vector<Point> requireGeographicNodes(const Grid& grid, const std::string& path, const std::string& model,
                                          const ItemLoop& loop = inOrder);

}  // namespace coastmesh
