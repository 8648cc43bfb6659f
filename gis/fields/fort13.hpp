#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// ADCIRC's nodal attributes: a title, the numbers of nodes and attributes; for each attribute its name, unit, number of
// values for a node, and default ones; for each its name again, and the nodes that have others. The default is the
// field's usual value, else the most frequent one. `kFloodPlain` stands behind the attributes that the file counts,
// where ADCIRC does not read: its log calls names that it does not know errors. REQUIRES: the grid has fields, all
// known. Throws OutputError.
void writeFort13(const std::string& path, const Grid& grid, const ItemLoop& loop);

// Adds the attributes of the file to a grid whose nodes have the numbers `ids` in their files, in order. Numbers of
// nodes (condensed_nodes) are left out, with a note. Throws InputError, also if the file has another number of nodes.
void readFort13(const std::string& path, const std::vector<std::int64_t>& ids, Grid& grid);

}  // namespace coastmesh
