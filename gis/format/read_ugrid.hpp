#pragma once

#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Reads the first two-dimensional mesh topology of a UGRID file, if its faces are triangles and quadrilaterals, for any
// names of variables. The CRS comes from the variable that grid_mapping names, or `projected_coordinate_system` or
// `wgs84`; longitudes without one are taken as WGS 84, other coordinates as `unsaid`. z: altitude or depth of the sea
// floor at the nodes, by standard_name, else by name, at the first time if there are several. Boundaries, lines,
// features, regions, pieces, parts, sizes, angles and areas as in files of `writeUgrid`. Throws InputError.
Grid readUgrid(const std::string& path, const Crs& unsaid);

// Names the variable and the time that z is taken from, if there are others, or the depths on faces if there are none
// at nodes; else empty. Throws InputError.
std::string depthRemark(const std::string& path);

}  // namespace coastmesh
