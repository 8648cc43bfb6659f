#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// SMS .2dm with a .prj beside it. z is elevation, positive up, 0 where the grid has none; the material is the number of
// the feature; boundaries are node strings that repeat the first node where they close, numbered as `boundaryMarker`
// says. Throws OutputError.
void write2dm(const Grid& grid, const std::string& path);

}  // namespace coastmesh
