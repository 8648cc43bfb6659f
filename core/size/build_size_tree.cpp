#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "core/large_list.hpp"
#include "core/metric.hpp"
#include "core/size/grade_leaves.hpp"
#include "core/size/size_cells.hpp"
#include "core/size/size_demand.hpp"
#include "core/size/size_leaves.hpp"
#include "core/size/size_subtrees.hpp"
#include "core/size/size_tree.hpp"
#include "core/size/size_tree_task.hpp"
#include "core/size/size_vertices.hpp"
#include "core/size/split_by_bounds.hpp"

namespace coastmesh {

namespace {

// Hundreds of loops over the cells of a small lake have a single item, for which it does not pay to wake threads.
ItemLoop withoutThreadsForOne(const ItemLoop& loop) {
  return [&loop](std::size_t count, const std::function<void(std::size_t)>& work) {
    count < 2 ? inOrder(count, work) : loop(count, work);
  };
}

SizeCells rootAround(const Point& low, const Point& high) {
  // Slightly larger, so that nothing lies on the root's own sides.
  const double extent = std::max(high.x - low.x, high.y - low.y);
  const double side = 1.01 * (extent > 0.0 ? extent : 1.0);
  SizeCells cells;
  cells.origin = midpoint(low, high) - Point{0.5 * side, 0.5 * side};
  cells.unit = side / SizeCells::kUnits;
  return cells;
}

}  // namespace

SizeTree::SizeTree(const Point& low, const Point& high, const SizeSource& source, const SizeTreeOptions& options,
                   const ItemLoop& loop) {
  const SizeTreeTask task{source, options, withoutThreadsForOne(loop)};
  SizeCells cells = rootAround(low, high);
  origin_ = cells.origin;
  side_ = cells.rootSide();
  SizeVertices vertices;
  SplitByBounds split = splitByBounds(cells, vertices, task);
  if (split.excess) {
    complete_ = false;
    demand_ = *split.excess;
    return;
  }
  balance(cells, task.loop);
  SizeLeaves leaves = numberLeaves(cells, vertices, std::move(split.own_vertices), task);
  complete_ = gradeLeaves(cells, vertices, leaves, task);
  demand_ = demandOfLeaves(cells, vertices, leaves, task);
  if (!complete_) return;
  storeCells(cells.cells, leaves.vertices, vertices.sizes.size, task.loop);
  makeStartTable();
}

// Stores cells and leaves depth first, so that neighbours are close in memory.
void SizeTree::storeCells(std::span<const Cell> cells, std::span<const LeafVertices> leaves,
                          std::span<const double> sizes, const ItemLoop& loop) {
  CellOrder order = orderDepthFirst(cells, leaves.size(), loop);
  cells_ = std::move(order.cells);
  reserveOn(loop, leaves_, leaves.size());
  leaves_.resize(leaves.size());
  const std::vector<SizeRange> parts = overStretches(loop, leaves.size(), [&](std::size_t first, std::size_t last) {
    SizeRange range{std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t l = first; l < last; ++l) {
      for (unsigned i = 0; i < 9; ++i) {
        const std::uint32_t v = leaves[l][i];
        leaves_[order.leaf[l]][i] = v == kNone ? std::nanf("") : static_cast<float>(sizes[v]);
        if (v == kNone) continue;
        range.low = std::min(range.low, sizes[v]);
        range.high = std::max(range.high, sizes[v]);
      }
    }
    return range;
  });
  least_ = std::numeric_limits<double>::infinity();
  for (const SizeRange& part : parts) {
    least_ = std::min(least_, part.low);
    most_ = std::max(most_, part.high);
  }
}

// In proportion to the tree.
void SizeTree::makeStartTable() {
  constexpr int kMostLevels = 11;
  while (start_levels_ < kMostLevels && (leaves_.size() >> (2 * start_levels_)) >= 16) ++start_levels_;
  const std::uint32_t starts = 1u << start_levels_;
  start_.resize(std::size_t{starts} * starts);
  start_level_.resize(start_.size());
  for (std::uint32_t j = 0; j < starts; ++j) {
    for (std::uint32_t i = 0; i < starts; ++i) {
      std::uint32_t c = 0;
      std::uint8_t level = 0;
      for (; level < start_levels_ && !cells_[c].is_leaf; ++level) {
        const std::uint32_t half = starts >> (level + 1);
        c = cells_[c].below + ((i & half) != 0) + 2 * ((j & half) != 0);
      }
      start_[(std::size_t{j} << start_levels_) + i] = c;
      start_level_[(std::size_t{j} << start_levels_) + i] = level;
    }
  }
}

}  // namespace coastmesh
