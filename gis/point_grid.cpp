#include "gis/point_grid.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

namespace coastmesh {

PointGrid::PointGrid(const std::vector<Point>& points, double tolerance, std::size_t expected_size)
    : points_(&points), tolerance_(tolerance), first_(std::bit_ceil(expected_size + expected_size / 2 + 8), kNone) {
  next_.reserve(expected_size);
}

PointGrid::Cell PointGrid::cellOf(double x, double y) const {
  if (tolerance_ == 0) return {std::bit_cast<std::int64_t>(x + 0.0), std::bit_cast<std::int64_t>(y + 0.0)};
  const double size = 4 * tolerance_;
  return {static_cast<std::int64_t>(std::floor(x / size)), static_cast<std::int64_t>(std::floor(y / size))};
}

std::size_t PointGrid::bucketOf(const Cell& cell) const {
  // Odd constants of Fibonacci hashing; the upper bits are the mixed ones.
  const std::uint64_t h = (static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15u) ^
                          (static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4Fu);
  const std::uint64_t mixed = (h ^ (h >> 32)) * 0x9E3779B97F4A7C15u;
  return static_cast<std::size_t>(mixed >> 20) & (first_.size() - 1);
}

void PointGrid::grow() {
  first_.assign(2 * first_.size(), kNone);
  for (VertexId v = 0; v < next_.size(); ++v) {
    const std::size_t bucket = bucketOf(cellOf((*points_)[v].x, (*points_)[v].y));
    next_[v] = first_[bucket];
    first_[bucket] = v;
  }
}

void PointGrid::add(VertexId v) {
  assert(v == next_.size());
  if (next_.size() > first_.size()) grow();
  const std::size_t bucket = bucketOf(cellOf((*points_)[v].x, (*points_)[v].y));
  next_.push_back(first_[bucket]);
  first_[bucket] = v;
}

VertexId PointGrid::find(const Point& p) const {
  const Cell low = cellOf(p.x - tolerance_, p.y - tolerance_), high = cellOf(p.x + tolerance_, p.y + tolerance_);
  VertexId best = kNone;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::int64_t x = low.x; x <= high.x; ++x) {
    for (std::int64_t y = low.y; y <= high.y; ++y) {
      for (VertexId v = first_[bucketOf({x, y})]; v != kNone; v = next_[v]) {
        const Point& q = (*points_)[v];
        const double distance = std::hypot(q.x - p.x, q.y - p.y);
        if (distance > tolerance_) continue;
        if (distance < best_distance || (distance == best_distance && v < best)) best = v, best_distance = distance;
      }
    }
  }
  return best;
}

}  // namespace coastmesh
