#pragma once

#include <vector>

#include "gis/grid.hpp"

namespace coastmesh {

// Gives the grid a feature for every fid and each triangle its own. Does nothing where `fids` (one a triangle) is empty or holds what no
// fid is: not a number, or past what a double tells apart.
void addFeatures(const std::vector<double>& fids, Grid& grid);

}  // namespace coastmesh
