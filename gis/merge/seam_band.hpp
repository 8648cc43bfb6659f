#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/merge_grids.hpp"

namespace coastmesh {

// The triangles along a seam that are to be meshed anew.
struct SeamBand {
  std::vector<std::uint8_t> taken;  // a flag for each triangle of the grid
  std::size_t triangles = 0;        // with a flag
  double largest = 0.0;             // the largest mean edge of them and of the inserted triangles beside them, metres
};

// The band of a grid that `mergeGrids` has made: the gap, the triangles of the grid around it, and those so near to the
// inserted mesh that sizes there would differ from its own by more than `gradation` times the distance along edges.
// Where the meshes adjoin at edges that both had, they stay as they are. Triangles of the inserted mesh are never in
// it.
SeamBand seamBand(const Grid& grid, const MergeReport& merged, double gradation, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
