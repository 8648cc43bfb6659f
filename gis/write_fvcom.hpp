#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// FVCOM's set: `lake_grd.dat` (cells and nodes), `lake_dep.dat` (depth, positive down), `lake_obc.dat` (nodes of open
// boundaries, type 1) and `lake_cor.dat` (latitudes; 0, which is no rotation, in a plane), with the CRS in a .prj.
// `path` is the first of them; without "_grd.dat" at its end it gives the name of the set. Rivers are shore here: FVCOM
// has them in its namelist. Throws OutputError, also where a depth is unknown.
void writeFvcom(const Grid& grid, const std::string& path);

// Reads the set, of which all but the first may be missing. Throws InputError.
Grid readFvcom(const std::string& path);

}  // namespace coastmesh
