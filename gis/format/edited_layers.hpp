#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// What counts where the layers of a mesh contradict each other, since one of them was edited alone, and the notes that
// say so.

// The depths of a layer of nodes, which has them twice: as a column of its table, and as the third coordinates of its
// points. Programs change one of them alone: a field calculator the former, tools for geometries the latter.
struct LayerDepths {
  std::vector<double> column, points;  // one for each node; NaN: none
};

// The depth of each node: that of the column, unless no node has one there, else that of its point. Differences of
// rounding are none: the point's number is exact. Adds a note if the two contradict each other at nodes, which have
// these `ids`.
std::vector<double> depthsIn(const LayerDepths& layer, std::span<const std::int64_t> ids,
                             std::vector<std::string>& notes);

// For triangles with corners where the layer of nodes has no point; these corners are nodes behind those of the layer,
// which have these `ids`. Measures such triangles anew, since their columns are of the time before the edit, and adds a
// note.
void measureNewCorners(Grid& grid, std::span<const std::int64_t> ids);

// Adds a note on edges of boundaries that are not on the outline of the triangles: some were deleted, for instance.
void noteStrayBoundaries(Grid& grid);

}  // namespace coastmesh
