#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/outline.hpp"

namespace coastmesh {

// For each node of the grid: the node of the outline that is the same, kNone if there is none. Nodes are the same
// within a hundredth of the shorter edge of the outline at its node; of several, the nearest.
std::vector<std::uint32_t> sameNodes(const Grid& grid, const Outline& outline, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
