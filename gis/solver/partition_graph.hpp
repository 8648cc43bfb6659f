#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/solver/mesh_graph.hpp"

namespace coastmesh {

// No part has more than this many times the mean work, if the weights allow it.
inline constexpr double kMostImbalance = 1.03;

struct PartitionFigures {
  std::uint64_t edge_cut = 0;         // edges of the graph between two parts
  double balance = 1.0;               // largest work of a part over the mean
  std::uint64_t connected_parts = 0;  // parts that are connected
  std::uint64_t least = 0, most = 0;  // vertices in the smallest and the largest part
};

// The part of each vertex, below `parts`; no part is empty. The result is the same for any loop. REQUIRES: 1 <= parts
// <= size. Throws std::bad_alloc.
std::vector<std::uint32_t> partitionGraph(const MeshGraph& graph, std::uint32_t parts, const ItemLoop& loop = inOrder);

PartitionFigures figuresOf(const MeshGraph& graph, const std::vector<std::uint32_t>& part_of, std::uint32_t parts);

}  // namespace coastmesh
