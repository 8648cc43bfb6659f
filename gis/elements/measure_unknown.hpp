#pragma once

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Measures the smallest angles and the areas of triangles that are unknown (NaN); an array that is empty stays so.
// Halves of a quadrilateral get the smallest of its own angles.
void measureUnknown(Grid& grid, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
