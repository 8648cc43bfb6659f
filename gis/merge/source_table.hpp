#pragma once

#include <span>
#include <string>

#include "core/item_loop.hpp"
#include "gis/elements/elements.hpp"
#include "gis/merge/merge_grids.hpp"

namespace coastmesh {

// Writes a table (CSV) of where the nodes and elements of a merged mesh come from, with the columns
// "item,number,mesh,source": "node", "triangle" or "quadrilateral", its number, that of the mesh and that in the mesh,
// all counted from 1; neither for new ones. `sources`: one for each of the elements. Throws OutputError.
void writeSourceTable(std::span<const MergeSource> nodes, const Elements& elements,
                      std::span<const MergeSource> sources, const std::string& path, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
