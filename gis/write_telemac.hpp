#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// TELEMAC's SELAFIN geometry in double precision (SERAFIND) with the variable BOTTOM, elevation in metres, and beside
// it the boundary conditions: `lake.slf` with `lake.cli`, and the CRS in a .prj. Shores are walls (2 2 2), open
// boundaries levels (5 4 4), rivers discharges (4 5 5). The file has codes for nodes only: the shore of a single edge
// between two openings becomes open with them. Throws OutputError, also where a z is unknown or the mesh touches
// itself in a node.
void writeTelemac(const Grid& grid, const std::string& path);

// Reads either precision, two-dimensional meshes of triangles alone, and the .cli where there is one. Throws InputError.
Grid readTelemac(const std::string& path);

}  // namespace coastmesh
