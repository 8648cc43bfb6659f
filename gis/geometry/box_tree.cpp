#include "gis/geometry/box_tree.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/hilbert.hpp"

namespace coastmesh {

namespace {

Point centreOf(const Box& box) { return {box.xmin / 2 + box.xmax / 2, box.ymin / 2 + box.ymax / 2}; }

// Empty boxes, which have no centre, take that of the box before them.
std::vector<Point> centresOf(const std::vector<Box>& boxes, const ItemLoop& loop) {
  const auto first = std::ranges::find_if_not(boxes, &Box::empty);
  const Point before_all = first != boxes.end() ? centreOf(*first) : Point{};
  std::vector<Point> centres(boxes.size());
  forStretches(loop, boxes.size(), [&](std::size_t begin, std::size_t end) {
    std::size_t before = begin;
    while (before > 0 && boxes[before - 1].empty()) --before;
    Point last = before > 0 ? centreOf(boxes[before - 1]) : before_all;
    for (std::size_t i = begin; i < end; ++i) {
      if (!boxes[i].empty()) last = centreOf(boxes[i]);
      centres[i] = last;
    }
  });
  return centres;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes, Order order, const ItemLoop& loop) {
  assert(boxes.size() <= std::numeric_limits<std::uint32_t>::max());
  if (boxes.empty()) return;
  if (order == Order::Hilbert) items_ = hilbertOrder(centresOf(boxes, loop), loop);
  level_begin_ = {0, boxes.size()};
  for (std::size_t count = boxes.size(); count > 1;) {
    count = (count + kFanout - 1) / kFanout;
    level_begin_.push_back(level_begin_.back() + count);
  }
  boxes_.resize(level_begin_.back());
  refit(loop, [&](std::uint32_t item) { return boxes[item]; });
}

void BoxTree::enclose(const ItemLoop& loop) {
  for (std::size_t level = 1; level + 1 < level_begin_.size(); ++level) {
    const std::size_t below = level_begin_[level - 1], begin = level_begin_[level], end = level_begin_[level + 1];
    forEachByStretches(loop, end - begin, [&](std::size_t node) {
      Box box;
      const std::size_t last = std::min(begin, below + (node + 1) * kFanout);
      for (std::size_t i = below + node * kFanout; i < last; ++i) box.add(boxes_[i]);
      boxes_[begin + node] = box;
    });
  }
}

}  // namespace coastmesh
