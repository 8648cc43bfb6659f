#include "gis/geometry/point_grid.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace coastmesh {

namespace {

// The width of a cell in tolerances: mostly, all points near another one are in its cell.
constexpr double kCellWidth = 16;

// Like std::floor, but without a function call.
std::int64_t roundedDown(double x) {
  const auto towards_zero = static_cast<std::int64_t>(x);
  return towards_zero - (x < static_cast<double>(towards_zero) ? 1 : 0);
}

}  // namespace

PointGrid::PointGrid(const std::vector<Point>& points, double tolerance, std::size_t expected_size)
    : points_(&points),
      tolerance_(tolerance),
      per_unit_(1 / (kCellWidth * tolerance)),
      slots_(std::bit_ceil(expected_size + expected_size / 2 + 8)) {}

PointGrid::Cell PointGrid::cellOf(double x, double y) const {
  if (tolerance_ == 0) return {std::bit_cast<std::int64_t>(x + 0.0), std::bit_cast<std::int64_t>(y + 0.0)};
  return {roundedDown(x * per_unit_), roundedDown(y * per_unit_)};
}

std::uint64_t PointGrid::hashOf(const Cell& cell) {
  // Odd constants of Fibonacci hashing; the upper bits are mixed best.
  const std::uint64_t h = (static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15u) ^
                          (static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4Fu);
  return (h ^ (h >> 32)) * 0x9E3779B97F4A7C15u;
}

void PointGrid::put(VertexId v) {
  const Point& p = (*points_)[v];
  const std::uint64_t hash = hashOf(cellOf(p.x, p.y));
  std::size_t slot = slotOf(hash);
  while (slots_[slot].vertex != kNone) slot = (slot + 1) & (slots_.size() - 1);
  slots_[slot] = {tagOf(hash), v};
}

void PointGrid::add(VertexId v) {
  assert(v == size_);
  if (3 * size_ > 2 * slots_.size()) {
    slots_.assign(2 * slots_.size(), {});
    for (VertexId w = 0; w < v; ++w) put(w);
  }
  put(v);
  ++size_;
}

VertexId PointGrid::find(const Point& p) const {
  const Cell low = cellOf(p.x - tolerance_, p.y - tolerance_), high = cellOf(p.x + tolerance_, p.y + tolerance_);
  VertexId best = kNone;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::int64_t x = low.x; x <= high.x; ++x) {
    for (std::int64_t y = low.y; y <= high.y; ++y) {
      const std::uint64_t hash = hashOf({x, y});
      for (std::size_t slot = slotOf(hash); slots_[slot].vertex != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
        if (slots_[slot].tag != tagOf(hash)) continue;
        const VertexId v = slots_[slot].vertex;
        const Point& q = (*points_)[v];
        if (!(std::abs(q.x - p.x) <= tolerance_ && std::abs(q.y - p.y) <= tolerance_)) continue;
        const double distance = std::hypot(q.x - p.x, q.y - p.y);
        if (distance > tolerance_) continue;
        if (distance < best_distance || (distance == best_distance && v < best)) {
          best = v;
          best_distance = distance;
        }
      }
    }
  }
  return best;
}

}  // namespace coastmesh
