#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// An undirected graph: a solver's units of work, and their communication. The neighbours of `i` are at [`first[i]`,
// `first[i + 1]`) in `neighbours`; each edge is listed at both of its ends.
struct MeshGraph {
  std::vector<std::int32_t> first{0};
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> weights;  // for each vertex: its work, 1 or more

  std::size_t size() const { return weights.size(); }
};

// Elements, joined if they share a side, all with the same work. Throws InputError for a grid too large for 32-bit
// numbers.
MeshGraph elementGraph(const Grid& grid, const ItemLoop& loop = inOrder);

// Nodes, joined by the edges of triangles and across weirs; the work of a node is its number of neighbours, as in
// adcprep, and 1 for a node without triangles. Throws InputError in the same way.
MeshGraph nodeGraph(const Grid& grid, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
