#include "gis/box_tree.hpp"

#include <cassert>
#include <numeric>

namespace coastmesh {

namespace {

// Position of the cell (x, y), 16 bits each, along the Hilbert curve.
std::uint32_t hilbertIndex(std::uint32_t x, std::uint32_t y) {
  std::uint32_t index = 0;
  for (std::uint32_t side = 1u << 15; side > 0; side >>= 1) {
    const std::uint32_t right = (x & side) ? 1 : 0, upper = (y & side) ? 1 : 0;
    index = (index << 2) | ((3 * right) ^ upper);
    if (upper == 0) {
      if (right == 1) x = ~x, y = ~y;
      std::swap(x, y);
    }
  }
  return index;
}

std::vector<std::uint32_t> hilbertOrder(const std::vector<Box>& boxes) {
  Box extent;
  for (const Box& box : boxes) extent.add(box);
  const double width = extent.xmax - extent.xmin, height = extent.ymax - extent.ymin;
  const double to_x = width > 0 ? 65535.0 / width : 0.0, to_y = height > 0 ? 65535.0 / height : 0.0;
  std::vector<std::uint64_t> keys(boxes.size());  // curve position above, item below: ties keep the order given
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i];
    const double x = (box.xmin / 2 + box.xmax / 2 - extent.xmin) * to_x;
    const double y = (box.ymin / 2 + box.ymax / 2 - extent.ymin) * to_y;
    const auto cell = [](double v) { return static_cast<std::uint32_t>(std::clamp(v, 0.0, 65535.0)); };
    keys[i] = (static_cast<std::uint64_t>(hilbertIndex(cell(x), cell(y))) << 32) | i;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> items(boxes.size());
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = static_cast<std::uint32_t>(keys[i]);
  return items;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes, Order order) {
  assert(boxes.size() <= std::numeric_limits<std::uint32_t>::max());
  if (boxes.empty()) return;
  boxes_.reserve(boxes.size() + boxes.size() / (kFanout - 1) + 16);
  if (order == Order::Hilbert) {
    items_ = hilbertOrder(boxes);
    for (const std::uint32_t item : items_) boxes_.push_back(boxes[item]);
  } else {
    boxes_ = boxes;
  }
  level_begin_ = {0, boxes_.size()};
  while (level_begin_.back() - level_begin_[level_begin_.size() - 2] > 1) {
    const std::size_t begin = level_begin_[level_begin_.size() - 2], end = level_begin_.back();
    for (std::size_t first = begin; first < end; first += kFanout) {
      Box box;
      for (std::size_t i = first; i < std::min(end, first + kFanout); ++i) box.add(boxes_[i]);
      boxes_.push_back(box);
    }
    level_begin_.push_back(boxes_.size());
  }
}

}  // namespace coastmesh
