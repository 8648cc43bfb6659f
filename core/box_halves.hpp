#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/point.hpp"

namespace coastmesh {

struct Bounds {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(const Point& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void add(const Bounds& other) {
    add(other.low);
    add(other.high);
  }
  Point middle() const { return {0.5 * low.x + 0.5 * high.x, 0.5 * low.y + 0.5 * high.y}; }
  bool holds(const Point& p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
  double squaredDistanceTo(const Point& p) const {
    const double dx = std::max({low.x - p.x, 0.0, p.x - high.x}), dy = std::max({low.y - p.y, 0.0, p.y - high.y});
    return dx * dx + dy * dy;
  }
};

// A binary tree of boxes, in Hilbert order: the children of node k are 2 k and 2 k + 1.
class BoxHalves {
 public:
  BoxHalves() = default;
  explicit BoxHalves(std::span<const Bounds> boxes);

  // Calls `found(item)` for every item whose ancestors all pass `enter(bounds)`.
  template <typename Enter, typename Found>
  void visit(const Enter& enter, const Found& found) const {
    if (!items_.empty()) visitFrom(1, 0, items_.size(), enter, found);
  }

 private:
  static constexpr std::size_t kLeaf = 4;

  void build(std::size_t node, std::size_t first, std::size_t last, std::span<const Bounds> boxes);

  template <typename Enter, typename Found>
  void visitFrom(std::size_t node, std::size_t first, std::size_t last, const Enter& enter, const Found& found) const {
    if (!enter(nodes_[node])) return;
    if (last - first <= kLeaf) {
      for (std::size_t i = first; i < last; ++i) found(items_[i]);
      return;
    }
    const std::size_t middle = first + (last - first) / 2;
    visitFrom(2 * node, first, middle, enter, found);
    visitFrom(2 * node + 1, middle, last, enter, found);
  }

  BulkList<std::uint32_t> items_;
  std::vector<Bounds> nodes_;
};

}  // namespace coastmesh
