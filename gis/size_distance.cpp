#include "gis/size_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/hilbert.hpp"
#include "core/metric.hpp"
#include "gis/segment_tags.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distanceTo(const Point& x, const Point& a, const Point& b) {
  const Point ab = b - a;
  const double squared = squaredLength(ab);
  const double share = squared > 0.0 ? std::clamp(dot(x - a, ab) / squared, 0.0, 1.0) : 0.0;
  return distance(x, a + share * ab);
}

double distanceTo(const Point& x, const Box& box) {
  const Point off{std::max({box.xmin - x.x, 0.0, x.x - box.xmax}), std::max({box.ymin - x.y, 0.0, x.y - box.ymax})};
  return std::sqrt(squaredLength(off));  // std::hypot would take most of the time
}

}  // namespace

DistanceField::DistanceField(std::vector<SizedLine> lines, std::function<double(const Point&)> scale, double most_m)
    : scale_(std::move(scale)), most_m_(most_m) {
  if (lines.empty()) return;
  std::vector<Point> middles;
  for (const SizedLine& line : lines) {
    middles.push_back(midpoint(line.a, line.b));
    most_rate_ = std::max(most_rate_, line.rate);
  }
  for (const std::uint32_t i : hilbertOrder(middles)) lines_.push_back(lines[i]);
  for (const SizedLine& line : lines_) nodes_.push_back({Box::of(line.a, line.b), line.size_m, line.rate});
  level_begin_ = {0, nodes_.size()};
  while (level_begin_.back() - level_begin_[level_begin_.size() - 2] > 1) {
    const std::size_t begin = level_begin_[level_begin_.size() - 2], end = level_begin_.back();
    for (std::size_t first = begin; first < end; first += kFanout) {
      Node node{{}, kInfinity, kInfinity};
      for (std::size_t i = first; i < std::min(end, first + kFanout); ++i) {
        node.box.add(nodes_[i].box);
        node.size_m = std::min(node.size_m, nodes_[i].size_m);
        node.rate = std::min(node.rate, nodes_[i].rate);
      }
      nodes_.push_back(node);
    }
    level_begin_.push_back(nodes_.size());
  }
}

void DistanceField::descend(std::size_t level, std::size_t node, const Point& x, double scale, double& best) const {
  const auto lineFrom = [&](std::size_t i) {
    const SizedLine& line = lines_[i];
    best = std::min(best, line.size_m + line.rate * distanceTo(x, line.a, line.b) / scale);
  };
  if (level == 0) return lineFrom(node);
  const std::size_t first = level_begin_[level - 1] + node * kFanout;
  const std::size_t count = std::min(level_begin_[level], first + kFanout) - first;
  if (level == 1) {
    for (std::size_t i = first; i < first + count; ++i) lineFrom(i);  // sooner done than put in order
    return;
  }
  // The most promising first.
  std::array<std::pair<double, std::size_t>, kFanout> order;
  for (std::size_t k = 0; k < count; ++k) {
    const Node& child = nodes_[first + k];
    order[k] = {child.size_m + child.rate * distanceTo(x, child.box) / scale, node * kFanout + k};
  }
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t k = 0; k < count; ++k) {
    if (order[k].first >= best) return;
    descend(level - 1, order[k].second, x, scale, best);
  }
}

double DistanceField::sizeAt(const Point& x, double scale, double start) const {
  if (lines_.empty()) return kInfinity;
  double best = start;
  descend(level_begin_.size() - 2, 0, x, scale, best);
  return best;
}

double DistanceField::startFrom(double size, const Point& from, const Point& x, double scale) const {
  return (size + most_rate_ * distance(from, x) / scale) * (1.0 + 1e-3);
}

void DistanceField::sample(std::span<const Point> places, std::span<double> sizes) const {
  double start = kInfinity;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double scale = scale_(places[i]);
    if (i > 0) start = startFrom(sizes[i - 1], places[i - 1], places[i], scale);
    sizes[i] = sizeAt(places[i], scale, std::min(start, most_m_));
  }
}

void DistanceField::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  if (lines_.empty()) {
    std::ranges::fill(ranges, SizeRange{kInfinity, kInfinity});
    return;
  }
  const double least = nodes_.back().size_m;
  double start = kInfinity, size = kInfinity;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double scale = scale_(boxes[i].centre);
    if (i > 0) start = startFrom(size, boxes[i - 1].centre, boxes[i].centre, scale);
    const double reach = most_rate_ * std::sqrt(2.0) * boxes[i].half / scale * 1.01;
    size = sizeAt(boxes[i].centre, scale, std::min(start, most_m_ + reach));
    ranges[i] = {std::max(least, size - reach), size + reach};
  }
}

std::vector<SizedLine> shoreLines(const Pslg& pslg, double size_m, double rate) {
  const bool labelled =
      std::ranges::any_of(pslg.segments, [](const Segment& s) { return s.left >= 0 || s.right >= 0; });
  std::vector<SizedLine> lines;
  for (const Segment& s : pslg.segments)
    if (!labelled || (s.tag != kOpenTag && (s.left >= 0) != (s.right >= 0)))
      lines.push_back({pslg.points[s.a], pslg.points[s.b], size_m, rate});
  return lines;
}

}  // namespace coastmesh
