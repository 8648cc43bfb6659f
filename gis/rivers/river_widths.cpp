#include "gis/rivers/river_widths.hpp"

#include <algorithm>
#include <limits>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

// Where features of different widths meet, and where a river was measured.
constexpr double kJoiningSlope = 0.2, kMeasuredSlope = 0.5;

}  // namespace

RiverWidths::RiverWidths(std::span<const PlaneRiver> rivers) : rivers_(rivers) {
  std::vector<Box> boxes;
  for (std::uint32_t line = 0; line < rivers.size(); ++line) {
    const PlaneRiver& river = rivers[line];
    for (std::uint32_t i = 0; i + 1 < river.widths.size(); ++i) {
      edges_.emplace_back(line, i);
      boxes.push_back(Box::of(river.points[i], river.points[i + 1]));
    }
  }
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

double RiverWidths::slopeOf(std::uint32_t line) const {
  return rivers_[line].widths.empty() ? kJoiningSlope : kMeasuredSlope;
}

double RiverWidths::at(std::uint32_t line, const Point& place) const {
  const PlaneRiver& river = rivers_[line];
  if (river.widths.empty()) return river.width;
  double gap = std::numeric_limits<double>::infinity(), width = 0.0;
  tree_.visit(Box::of(place, place).grownBy(river.width), [&](std::uint32_t e) {
    const auto& [of, i] = edges_[e];
    if (of != line) return;
    const Point &a = river.points[i], &b = river.points[i + 1];
    const double distance = squaredDistanceToSegment(place, a, b);
    if (distance >= gap) return;
    gap = distance;
    const double share = shareAlongSegment(place, a, b);
    width = river.widths[i] + share * (river.widths[i + 1] - river.widths[i]);
  });
  if (width > 0.0) return width;
  const bool starts = squaredDistance(place, river.points.front()) < squaredDistance(place, river.points.back());
  return starts ? river.widths.front() : river.widths.back();
}

}  // namespace coastmesh
