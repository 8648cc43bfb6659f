#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/flood_plain/flooded_cells.hpp"

namespace coastmesh {

// The contours of flooded cells: rings with the low land on their left, in the coordinates of the lattice, none of
// which meets itself or another (marching squares). Between the centres of a low cell and a higher one they pass where
// the height is the limit, interpolated linearly, but not within a tenth of a cell of a centre; where a height is
// unknown, halfway. Flooded land at the water or the frame is continued beyond by a cell.
std::vector<Ring> floodContours(const FloodedCells& cells, const HeightCells& heights, double limit_m);

}  // namespace coastmesh
