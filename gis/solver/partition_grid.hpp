#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"
#include "gis/solver/partition_graph.hpp"
#include "gis/solver/vertical_levels.hpp"

namespace coastmesh {

// Some solvers distribute elements, others nodes. Their work is the same everywhere, but for nodes, which have as much
// as neighbours, unless something else is given.
struct PartitionOptions {
  std::uint32_t parts = 0;  // 0: no partition
  bool elements = false;
  bool nodes = false;
  std::string attribute{};                 // nodal attribute that is the work of a node; empty: none
  std::optional<VerticalLevels> levels{};  // the work is the number of layers; without `attribute`
};

struct PartitionReport {
  std::uint32_t parts = 0;  // 0: the grid was not partitioned
  bool mixed = false;       // elements are not triangles alone
  std::string weight{};     // "even", "layers" or the attribute's name
  std::optional<PartitionFigures> elements, nodes;
};

// Sets `part_of` and `node_part_of` of the grid, as requested. Throws InputError if it has fewer elements or nodes than
// parts, and if their work is unknown.
PartitionReport partitionGrid(Grid& grid, const PartitionOptions& options, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
