#include "core/box_halves.hpp"

#include <bit>

#include "core/hilbert.hpp"

namespace coastmesh {

BoxHalves::BoxHalves(std::span<const Bounds> boxes) {
  if (boxes.empty()) return;
  std::vector<Point> middles;
  middles.reserve(boxes.size());
  for (const Bounds& box : boxes) middles.push_back(box.middle());
  items_ = hilbertOrder(middles);
  nodes_.resize(4 * std::bit_ceil(items_.size() / kLeaf + 1));
  build(1, 0, items_.size(), boxes);
}

void BoxHalves::build(std::size_t node, std::size_t first, std::size_t last, std::span<const Bounds> boxes) {
  if (last - first <= kLeaf) {
    for (std::size_t i = first; i < last; ++i) nodes_[node].add(boxes[items_[i]]);
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  build(2 * node, first, middle, boxes);
  build(2 * node + 1, middle, last, boxes);
  nodes_[node].add(nodes_[2 * node]);
  nodes_[node].add(nodes_[2 * node + 1]);
}

}  // namespace coastmesh
