#include "gis/geometry/box_tree.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/hilbert.hpp"

namespace coastmesh {

namespace {

Point centreOf(const Box& box) { return {box.xmin / 2 + box.xmax / 2, box.ymin / 2 + box.ymax / 2}; }

// Empty boxes, which have no centre, take that of the box before them.
std::vector<std::uint32_t> orderByCentre(const std::vector<Box>& boxes) {
  const auto first = std::ranges::find_if_not(boxes, &Box::empty);
  Point last = first != boxes.end() ? centreOf(*first) : Point{};
  std::vector<Point> centres;
  centres.reserve(boxes.size());
  for (const Box& box : boxes) {
    if (!box.empty()) last = centreOf(box);
    centres.push_back(last);
  }
  return hilbertOrder(centres);
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes, Order order) {
  assert(boxes.size() <= std::numeric_limits<std::uint32_t>::max());
  if (boxes.empty()) return;
  boxes_.reserve(boxes.size() + boxes.size() / (kFanout - 1) + 16);
  if (order == Order::Hilbert) {
    items_ = orderByCentre(boxes);
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
