#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// ADCIRC's fort.14, depth positive down, and the CRS in a .prj beside it. Throws OutputError, also where a depth is
// unknown.
void writeAdcirc(const Grid& grid, const std::string& path);

// Reads it back, with what is wrong in it as `notes`. Throws InputError.
Grid readAdcirc(const std::string& path);

}  // namespace coastmesh
