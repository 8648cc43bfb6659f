#pragma once

#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// The first two-dimensional mesh topology of a UGRID file, if its faces are triangles, whatever its variables are
// called. The CRS comes from the variable that grid_mapping names, or `projected_coordinate_system` or `wgs84`;
// longitudes without one are taken as WGS 84, other coordinates as a plane. z: altitude or depth of the sea floor at
// the nodes, by its standard_name or else by its name. Boundaries, features, angles and areas as `writeUgrid` writes
// them. Throws InputError.
Grid readUgrid(const std::string& path, const Crs& unsaid);

// Which variable z is taken from, where others would do as well; else empty. Throws InputError.
std::string depthRemark(const std::string& path);

}  // namespace coastmesh
