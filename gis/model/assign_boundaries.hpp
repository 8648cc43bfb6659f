#pragma once

#include <functional>

#include "gis/grid/grid.hpp"
#include "gis/model/boundary_edges.hpp"

namespace coastmesh {

// Changes the grid's boundaries according to the options. A warning says where depths open a winding line, which is a
// coast rather than the sea's outer limit. Throws InputError.
BoundaryReport assignBoundaries(Grid& grid, const BoundaryOptions& options, const ItemLoop& loop = inOrder);

// The open boundaries that are a single edge between shores, as where a side of a frame cuts only the tip of a water.
struct LoneOpenings {
  std::size_t count = 0;
  double longest_m = 0.0;
  Point place;  // the middle of the longest
};
// `counts(boundary)`: which ones are to be found; empty: all.
LoneOpenings loneOpenings(const Grid& grid, const std::function<bool(const Boundary&)>& counts = {});

}  // namespace coastmesh
