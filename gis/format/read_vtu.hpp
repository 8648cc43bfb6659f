#pragma once

#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Node data with longitudes and latitudes, for a mesh on a globe, whose points are in space.
inline constexpr const char *kVtuLongitude = "longitude", *kVtuLatitude = "latitude";

// Reads VTK's unstructured grid of triangles as XML: arrays appended (raw or base64) or inline (ASCII or base64), not
// compressed or with zlib. Lines and points among the cells are ignored. z: node data "z", else "depth" or
// "bathymetry", positive down, else the third coordinate if it is not 0 throughout and the mesh is not on a globe, else
// "elevation" or "bed_level"; names in any case. What `writeVtu` adds is read too. The CRS is WGS 84 on a globe, else
// that of a .prj beside the file, else `unsaid`. Throws InputError.
Grid readVtu(const std::string& path, const Crs& unsaid);

}  // namespace coastmesh
