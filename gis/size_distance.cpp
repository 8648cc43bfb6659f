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
  return std::hypot(std::max({box.xmin - x.x, 0.0, x.x - box.xmax}), std::max({box.ymin - x.y, 0.0, x.y - box.ymax}));
}

}  // namespace

DistanceField::DistanceField(std::vector<SizedLine> lines, std::function<double(const Point&)> scale)
    : scale_(std::move(scale)) {
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
  if (level == 0) {
    const SizedLine& line = lines_[node];
    best = std::min(best, line.size_m + line.rate * distanceTo(x, line.a, line.b) / scale);
    return;
  }
  // The most promising first.
  const std::size_t first = level_begin_[level - 1] + node * kFanout;
  const std::size_t count = std::min(level_begin_[level], first + kFanout) - first;
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

void DistanceField::sample(std::span<const Point> places, std::span<double> sizes) const {
  double start = kInfinity;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double scale = scale_(places[i]);
    // No more than it was nearby, and what the way from there adds.
    if (i > 0 && std::isfinite(sizes[i - 1]))
      start = (sizes[i - 1] + most_rate_ * distance(places[i - 1], places[i]) / scale) * (1.0 + 1e-3);
    sizes[i] = sizeAt(places[i], scale, start);
  }
}

void DistanceField::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  if (lines_.empty()) {
    std::ranges::fill(ranges, SizeRange{kInfinity, kInfinity});
    return;
  }
  double least = kInfinity;
  least = nodes_.back().size_m;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double scale = scale_(boxes[i].centre);
    const double size = sizeAt(boxes[i].centre, scale, kInfinity);
    const double reach = most_rate_ * std::sqrt(2.0) * boxes[i].half / scale * 1.01;
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
