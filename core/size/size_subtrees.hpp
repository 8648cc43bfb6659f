#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/large_list.hpp"
#include "core/size/size_tree.hpp"

namespace coastmesh {

// The cells of a quadtree in depth-first order, worked on by subtrees: results do not depend on threads. Cell 0 is the
// root.

// All leaves, as numbers of cells.
std::vector<std::uint32_t> leavesDepthFirst(std::span<const SizeTree::Cell> cells, const ItemLoop& loop);

struct CellOrder {
  std::vector<SizeTree::Cell> cells;
  BulkList<std::uint32_t> leaf;  // for each leaf its new number
};
// The same cells, with the children of a cell after those of all cells split before it, and leaves numbered in this
// order, so that neighbours are close in memory. REQUIRES: leaves have numbers below `leaves`, each once.
CellOrder orderDepthFirst(std::span<const SizeTree::Cell> cells, std::size_t leaves, const ItemLoop& loop);

}  // namespace coastmesh
