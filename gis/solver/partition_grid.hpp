#pragma once

#include <cstdint>
#include <optional>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"
#include "gis/solver/partition_graph.hpp"

namespace coastmesh {

// Some solvers distribute elements, others nodes.
struct PartitionOptions {
  std::uint32_t parts = 0;  // 0: no partition
  bool elements = false;
  bool nodes = false;
};

struct PartitionReport {
  std::uint32_t parts = 0;  // 0: the grid was not partitioned
  bool mixed = false;       // elements are not triangles alone
  std::optional<PartitionFigures> elements, nodes;
};

// Sets `part_of` and `node_part_of` of the grid, as requested. Throws InputError if it has fewer elements or nodes than
// parts.
PartitionReport partitionGrid(Grid& grid, const PartitionOptions& options, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
