#include "gis/size/size_floor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "core/metric.hpp"
#include "core/size/on_surface.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kTolerance = 0.05;            // relative: a square whose sizes differ by less is not steep
constexpr std::size_t kMostNodes = 4'000'000;  // beyond this squares are not divided

SizeBox childOf(const SizeBox& box, unsigned i) {
  const double half = 0.5 * box.half;
  return {box.centre + Point{(i & 1U) != 0U ? half : -half, (i & 2U) != 0U ? half : -half}, half};
}

// A lower bound of the distance of two boxes on the surface.
double distanceBetween(const Surface& surface, const SizeBox& a, const SizeBox& b) {
  if (surface.isCurved()) {
    const auto reach = [&](const SizeBox& box) { return std::numbers::sqrt2 * box.half * shrinkIn(surface, box).high; };
    return std::max(0.0, arcBetween(surface, a.centre, b.centre) - reach(a) - reach(b));
  }
  const double dx = std::max(0.0, std::abs(a.centre.x - b.centre.x) - a.half - b.half);
  const double dy = std::max(0.0, std::abs(a.centre.y - b.centre.y) - a.half - b.half);
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

SizeFloor::SizeFloor(std::unique_ptr<SizeField> field, double rate, double least_m,
                     std::function<double(const Point&)> scale, const SizeBox& root, const DomainMask& mask,
                     const ItemLoop& loop, const Surface& surface)
    : field_(std::move(field)),
      rate_(rate),
      least_m_(least_m),
      scale_(std::move(scale)),
      surface_(surface),
      root_(root) {
  build(mask, loop);
}

void SizeFloor::build(const DomainMask& mask, const ItemLoop& loop) {
  nodes_.assign(1, {});
  std::vector<std::pair<std::uint32_t, SizeBox>> level{{0, root_}};
  while (!level.empty()) {
    std::vector<SizeBox> boxes;
    for (const auto& entry : level) boxes.push_back(entry.second);
    std::vector<SizeRange> ranges(boxes.size());
    std::vector<double> known(boxes.size());  // an upper bound in the part where the field is known
    forStretches(loop, boxes.size(), [&](std::size_t first, std::size_t last) {
      const auto here = std::span(boxes).subspan(first, last - first);
      field_->bound(here, std::span(ranges).subspan(first, last - first));
      for (std::size_t i = first; i < last; ++i)
        known[i] = ranges[i].high < kInfinity || ranges[i].low == kInfinity ? ranges[i].high : field_->mostIn(boxes[i]);
    });
    std::vector<std::pair<std::uint32_t, SizeBox>> next;
    for (std::size_t i = 0; i < level.size(); ++i) {
      const auto& [node, box] = level[i];
      const double low = ranges[i].low, high = ranges[i].high;
      // The end of the field is a cliff too, wherever it is: smaller sizes beyond it would be graded into the domain.
      if (high < kInfinity && !mask.meets(box)) continue;
      if (low == kInfinity) continue;                                     // nothing is known
      if (high < kInfinity && high - low <= kTolerance * high) continue;  // not steep
      const double most = known[i];
      if (most <= least_m_) continue;
      const double by_its_size = rate_ * 2.0 * box.half * shrinkIn(surface_, box).high / measureAt(box.centre);
      if (by_its_size > kTolerance * most && nodes_.size() + 4 <= kMostNodes) {
        nodes_[node].below = static_cast<std::uint32_t>(nodes_.size());
        for (unsigned c = 0; c < 4; ++c) {
          next.emplace_back(static_cast<std::uint32_t>(nodes_.size()), childOf(box, c));
          nodes_.emplace_back();
        }
      } else {
        nodes_[node].most = std::nextafter(static_cast<float>(most), std::numeric_limits<float>::max());
      }
    }
    level = std::move(next);
  }
  for (std::size_t n = nodes_.size(); n-- > 0;)
    if (const std::uint32_t below = nodes_[n].below; below != 0)
      for (unsigned c = 0; c < 4; ++c) nodes_[n].most = std::max(nodes_[n].most, nodes_[below + c].most);
}

void SizeFloor::descend(std::uint32_t node, const SizeBox& box, const SizeBox& asked, double rate, double& most) const {
  const std::uint32_t below = nodes_[node].below;
  if (below == 0) {
    most = std::max(most, nodes_[node].most - rate * distanceBetween(surface_, box, asked));
    return;
  }
  std::array<std::pair<double, unsigned>, 4> order;
  for (unsigned c = 0; c < 4; ++c)
    order[c] = {nodes_[below + c].most - rate * distanceBetween(surface_, childOf(box, c), asked), c};
  std::ranges::sort(order, std::greater());
  for (const auto& [reaches, c] : order) {
    if (!(reaches > most)) return;
    descend(below + c, childOf(box, c), asked, rate, most);
  }
}

double SizeFloor::steepMost(const SizeBox& asked, double most) const {
  descend(0, root_, asked, rate_ / measureAt(asked.centre), most);
  return most;
}

void SizeFloor::raiseNear(std::unique_ptr<SizeField> distances, double factor) {
  distances_ = std::move(distances);
  factor_ = factor;
}

void SizeFloor::sample(std::span<const Point> places, std::span<double> sizes) const {
  field_->sample(places, sizes);
  for (std::size_t i = 0; i < places.size(); ++i)
    sizes[i] = steepMost({places[i], 0.0}, std::isfinite(sizes[i]) ? sizes[i] : 0.0);
  if (!distances_) return;
  std::vector<double> from(places.size());
  distances_->sample(places, from);
  for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = std::max(sizes[i], factor_ * sizes[i] - from[i]);
}

void SizeFloor::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  field_->bound(boxes, ranges);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const SizeBox& box = boxes[i];
    auto& [low, high, at_centre, is_graded] = ranges[i];
    at_centre = kUnknown;
    const bool none = low == kInfinity, part = !none && high == kInfinity;
    const double change = rate_ * std::numbers::sqrt2 * box.half * shrinkIn(surface_, box).high / measureAt(box.centre);
    low = steepMost({box.centre, 0.0}, change + (none || part ? 0.0 : low)) - change;
    high = steepMost(box, none ? 0.0 : high);
  }
  if (!distances_) return;
  std::vector<SizeRange> from(boxes.size());
  distances_->bound(boxes, from);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    double &low = ranges[i].low, &high = ranges[i].high;
    low = std::max(low, factor_ * low - from[i].high);
    high = std::max(high, factor_ * high - from[i].low);
  }
}

}  // namespace coastmesh
