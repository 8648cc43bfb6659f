#pragma once

#include <vector>

#include "gis/check/target_defect.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Nodes of weirs, on both shores, where the bed is higher than the crest, or than a pipe through the weir:
// BedAboveCrest, by how many metres, at which ADCIRC stops. In the order of the boundaries.
std::vector<TargetDefect> checkWeirs(const Grid& grid);

}  // namespace coastmesh
