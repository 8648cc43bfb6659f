#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A static tree over boxes, packed in one array: level 0 has the boxes themselves, each box of a higher level encloses
// kFanout neighbours of the level below. Neighbours are consecutive in the given order (for the edges of a chain, which
// are close together anyway) or along a Hilbert curve. After Roussopoulos & Leifker, "Direct spatial search on
// pictorial databases using packed R-trees" (1985), and Kamel & Faloutsos, "On packing R-trees" (1993).
// Boost.Geometry's R-tree does not expose its nodes. ChainIndex needs them: if a node lies entirely to one side of a
// point, the ends of its part of the chain are enough.
class BoxTree {
 public:
  enum class Order { Given, Hilbert };

  BoxTree() = default;
  // `loop` may use threads: the tree is the same.
  BoxTree(const std::vector<Box>& boxes, Order order, const ItemLoop& loop = inOrder);

  // Replaces all boxes, by `boxOf(item)`, and keeps the order: good while most boxes change little. Empty boxes are not
  // found.
  template <typename BoxOf>
  void refit(const ItemLoop& loop, BoxOf&& boxOf) {
    forEachByStretches(loop, size(), [&](std::size_t i) { boxes_[i] = boxOf(itemAt(i)); });
    enclose(loop);
  }

  std::size_t size() const { return level_begin_.empty() ? 0 : level_begin_[1]; }
  Box bounds() const { return boxes_.empty() ? Box{} : boxes_.back(); }

  // Items in blocks of neighbours. REQUIRES: Order::Hilbert.
  std::size_t blockCount() const { return (size() + kFanout - 1) / kFanout; }
  std::span<const std::uint32_t> block(std::size_t number) const {
    const std::size_t first = number * kFanout;
    return {items_.data() + first, std::min(size() - first, kFanout)};
  }

  // Calls `found(item)` for every item whose box meets `query`.
  template <typename Found>
  void visit(const Box& query, Found&& found) const {
    descend([&](const Box& box, std::size_t, std::size_t) { return box.meets(query); }, found);
  }

  // Calls `enter(box, first, last)` for nodes from the root down, and visits the children of those for which it returns
  // true; [first, last) are positions in the packed order (items, for Order::Given). Calls `found(item)` for the items
  // entered.
  template <typename Enter, typename Found>
  void descend(Enter&& enter, Found&& found) const {
    if (boxes_.empty()) return;
    descendFrom(level_begin_.size() - 2, 0, enter, found);
  }

 private:
  static constexpr std::size_t kFanout = 8;

  std::uint32_t itemAt(std::size_t i) const { return items_.empty() ? static_cast<std::uint32_t>(i) : items_[i]; }

  // Sets the boxes of the levels above the lowest.
  void enclose(const ItemLoop& loop);

  template <typename Enter, typename Found>
  void descendFrom(std::size_t level, std::size_t node, Enter& enter, Found& found) const {
    const std::size_t first = node << (3 * level);
    const std::size_t last = std::min(size(), (node + 1) << (3 * level));
    if (!enter(boxes_[level_begin_[level] + node], first, last)) return;
    if (level == 0) {
      found(itemAt(node));
      return;
    }
    const std::size_t below = level_begin_[level] - level_begin_[level - 1];
    const std::size_t end = std::min(below, (node + 1) * kFanout);
    for (std::size_t child = node * kFanout; child < end; ++child) descendFrom(level - 1, child, enter, found);
  }

  std::vector<Box> boxes_;                // level after level, the root last
  std::vector<std::size_t> level_begin_;  // where each level begins in `boxes_`, and the end
  BulkList<std::uint32_t> items_;         // level 0's items; empty for Order::Given
};

}  // namespace coastmesh
