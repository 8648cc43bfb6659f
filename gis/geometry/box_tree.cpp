#include "gis/geometry/box_tree.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

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

// `hilbertOrder` by all threads.
std::vector<std::uint32_t> orderAlongCurve(const std::vector<Point>& points, const ItemLoop& loop) {
  constexpr std::size_t kWorthThreads = 1 << 15;
  const Box all = boxAround(points, loop);
  const double scale = 65535.0 / std::max(all.xmax - all.xmin, all.ymax - all.ymin);
  if (points.size() < kWorthThreads || !std::isfinite(scale) || scale == 0.0) return hilbertOrder(points);
  // The index on the curve, then the number.
  std::vector<std::uint64_t> keys(points.size());
  forEachByStretches(loop, keys.size(), [&](std::size_t i) {
    const auto cell = [scale](double from, double at) { return static_cast<std::uint32_t>((at - from) * scale); };
    const std::uint32_t index = hilbertIndex(cell(all.xmin, points[i].x), cell(all.ymin, points[i].y));
    keys[i] = std::uint64_t{index} << 32 | i;
  });
  sortOn(loop, keys);
  std::vector<std::uint32_t> order(keys.size());
  forEachByStretches(loop, keys.size(), [&](std::size_t i) { order[i] = static_cast<std::uint32_t>(keys[i]); });
  return order;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes, Order order, const ItemLoop& loop) {
  assert(boxes.size() <= std::numeric_limits<std::uint32_t>::max());
  if (boxes.empty()) return;
  boxes_.reserve(boxes.size() + boxes.size() / (kFanout - 1) + 16);
  boxes_ = boxes;
  if (order == Order::Hilbert) {
    items_ = orderAlongCurve(centresOf(boxes, loop), loop);
    forEachByStretches(loop, boxes.size(), [&](std::size_t i) { boxes_[i] = boxes[items_[i]]; });
  }
  level_begin_ = {0, boxes_.size()};
  while (level_begin_.back() - level_begin_[level_begin_.size() - 2] > 1) {
    const std::size_t begin = level_begin_[level_begin_.size() - 2], end = level_begin_.back();
    const std::size_t above = (end - begin + kFanout - 1) / kFanout;
    boxes_.resize(end + above);
    forEachByStretches(loop, above, [&](std::size_t node) {
      const std::size_t first = begin + node * kFanout;
      for (std::size_t i = first; i < std::min(end, first + kFanout); ++i) boxes_[end + node].add(boxes_[i]);
    });
    level_begin_.push_back(boxes_.size());
  }
}

}  // namespace coastmesh
