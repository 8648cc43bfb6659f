#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// Gmsh 2 ASCII as WAVEWATCH III has it: z is the depth, positive down; nodes of open boundaries come first as elements
// of type 15, then the triangles with three tags. The CRS goes into a .prj. Throws OutputError, also where a depth is
// unknown.
void writeWw3(const Grid& grid, const std::string& path);

// Throws InputError.
Grid readWw3(const std::string& path);

}  // namespace coastmesh
