#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// SCHISM's hgrid.gr3 in the grid's CRS, hgrid.ll beside it in longitudes and latitudes (not for a plane), and the CRS in
// a .prj; depth positive down. `path` may name either file. Throws OutputError, also where a depth is unknown.
void writeSchism(const Grid& grid, const std::string& path);

// Reads either file: a .ll is in WGS 84. Throws InputError.
Grid readSchism(const std::string& path);

}  // namespace coastmesh
