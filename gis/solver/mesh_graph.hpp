#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// An undirected graph: what a solver works on, and what has to talk to what. The neighbours of `i` are those from
// `first[i]` to `first[i + 1]`; each edge is there from both of its ends.
struct MeshGraph {
  std::vector<std::int32_t> first{0};
  std::vector<std::int32_t> neighbours;
  std::vector<std::int32_t> weights;  // one a vertex: its work, 1 or more

  std::size_t size() const { return weights.size(); }
};

// Triangles, joined where they share a side; all of them are the same work. Throws InputError for a grid too large for
// 32-bit numbers.
MeshGraph elementGraph(const Grid& grid, const ItemLoop& loop = inOrder);

// Nodes, joined by the edges of triangles and across weirs; the work of a node is how many neighbours it has, as
// adcprep counts it, and 1 for a node of no triangle. Throws InputError likewise.
MeshGraph nodeGraph(const Grid& grid, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
