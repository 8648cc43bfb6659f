#pragma once

#include <span>
#include <string>

#include "core/item_loop.hpp"
#include "gis/merge/merge_grids.hpp"

namespace coastmesh {

// Writes a table (CSV) of where the nodes and triangles of a merged mesh come from, with the columns
// "item,number,mesh,source": "node" or "triangle", its number, that of the mesh and that in the mesh, all counted from
// 1; neither for new ones. Throws OutputError.
void writeSourceTable(std::span<const MergeSource> nodes, std::span<const MergeSource> triangles,
                      const std::string& path, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
