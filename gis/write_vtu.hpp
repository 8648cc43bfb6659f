#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// VTK's unstructured grid, appended raw, for ParaView: nodes at the coordinates of the CRS, z as node data, smallest
// angle, area and source fid as cell data. VTK has no word for a CRS. Throws OutputError.
void writeVtu(const Grid& grid, const std::string& path);

}  // namespace coastmesh
