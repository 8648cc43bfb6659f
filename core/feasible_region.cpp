#include "core/feasible_region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coastmesh {

namespace {

struct Disk {
  Point centre;
  double radius;
};

// The points that see the link edge under at least the smallest angle, from the left. REQUIRES: bound.min_angle > 0.
Disk petalOf(const LinkEdge& e, const TriangleBound& bound) {
  const Point d = e.y - e.x;
  const double height = 0.5 * bound.cos_min / bound.sin_min;
  const Point mid = midpoint(e.x, e.y);
  return {{mid.x - height * d.y, mid.y + height * d.x}, 0.5 * std::sqrt(squaredLength(d)) / bound.sin_min};
}

Point turned(const Point& d, double cosine, double sine) {
  return {cosine * d.x - sine * d.y, sine * d.x + cosine * d.y};
}

// Calls `half_plane(on, direction)` for every line that bounds the region; the region lies to the left. Stops at a
// false.
template <typename F>
bool forEachHalfPlane(std::span<const LinkEdge> link, const TriangleBound& bound, F&& half_plane) {
  const bool upper = bound.max_angle < std::numbers::pi - 2.0 * bound.min_angle;
  const double sin_max = std::sin(bound.max_angle);
  for (const LinkEdge& e : link) {
    const Point d = e.y - e.x;
    if (!half_plane(e.x, turned(d, bound.cos_min, bound.sin_min))) return false;
    if (!half_plane(e.y, turned(d, bound.cos_min, -bound.sin_min))) return false;
    if (!upper) continue;
    if (!half_plane(e.x, turned(d, -bound.cos_max, -sin_max))) return false;
    if (!half_plane(e.y, turned(d, -bound.cos_max, sin_max))) return false;
  }
  return true;
}

template <typename F>
void forEachDisk(std::span<const LinkEdge> link, const TriangleBound& bound, F&& disk) {
  for (const LinkEdge& e : link) {
    if (bound.min_angle > 0.0) disk(petalOf(e, bound));
    if (std::isinf(bound.squared_size)) continue;
    // Both ends: an open link has a last corner that starts no edge.
    disk(Disk{e.x, std::sqrt(bound.squared_size)});
    disk(Disk{e.y, std::sqrt(bound.squared_size)});
  }
}

}  // namespace

bool FeasibleRegion::clip(const Point& on, const Point& direction) {
  const auto side = [&](const Point& p) { return cross(direction, p - on); };
  clipped_.clear();
  double before = side(polygon_.back());
  Point last = polygon_.back();
  bool cut = false;
  for (const Point& p : polygon_) {
    const double here = side(p);
    if ((before < 0.0) != (here < 0.0)) clipped_.push_back(last + (before / (before - here)) * (p - last));
    if (here >= 0.0) {
      clipped_.push_back(p);
    } else {
      cut = true;
    }
    before = here;
    last = p;
  }
  if (cut) polygon_.swap(clipped_);
  return polygon_.size() >= 3;
}

Point FeasibleRegion::centre() const {
  Point sum;
  for (const Point& p : polygon_) sum = sum + p;
  return (1.0 / static_cast<double>(polygon_.size())) * sum;
}

std::optional<Point> FeasibleRegion::findPoint(std::span<const LinkEdge> link, const TriangleBound& bound) {
  Point low = link.front().x, high = link.front().x;
  for (const LinkEdge& e : link) {
    low = {std::min(low.x, e.x.x), std::min(low.y, e.x.y)};
    high = {std::max(high.x, e.x.x), std::max(high.y, e.x.y)};
  }
  forEachDisk(link, bound, [&](const Disk& d) {
    low = {std::max(low.x, d.centre.x - d.radius), std::max(low.y, d.centre.y - d.radius)};
    high = {std::min(high.x, d.centre.x + d.radius), std::min(high.y, d.centre.y + d.radius)};
  });
  if (low.x >= high.x || low.y >= high.y) return std::nullopt;
  polygon_.assign({low, {high.x, low.y}, high, {low.x, high.y}});
  if (!forEachHalfPlane(link, bound, [this](const Point& on, const Point& direction) { return clip(on, direction); }))
    return std::nullopt;

  constexpr int kMostCuts = 12;
  for (int cuts = 0; cuts < kMostCuts; ++cuts) {
    const Point c = centre();
    double worst = 0.0;
    Disk broken{};
    forEachDisk(link, bound, [&](const Disk& d) {
      const double excess = squaredDistance(c, d.centre) - d.radius * d.radius;
      if (excess <= worst) return;
      worst = excess;
      broken = d;
    });
    if (worst == 0.0) return c;
    const Point outward = c - broken.centre;
    const Point on = broken.centre + (broken.radius / std::sqrt(squaredLength(outward))) * outward;
    if (!clip(on, {-outward.y, outward.x})) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Point> FeasibleRegion::findPointBetween(const Point& a, const Point& b, std::span<const LinkEdge> link,
                                                      const TriangleBound& bound) {
  const Point along = b - a;
  double low = 0.0, high = 1.0;
  forEachHalfPlane(link, bound, [&](const Point& on, const Point& direction) {
    // cross(direction, a + s along - on) >= 0
    const double at_a = cross(direction, a - on), slope = cross(direction, along);
    if (slope > 0.0) low = std::max(low, -at_a / slope);
    if (slope < 0.0) high = std::min(high, -at_a / slope);
    if (slope == 0.0 && at_a < 0.0) high = -1.0;
    return low < high;
  });
  forEachDisk(link, bound, [&](const Disk& d) {
    const Point offset = a - d.centre;
    const double qa = squaredLength(along), qb = dot(along, offset), qc = squaredLength(offset) - d.radius * d.radius;
    const double discriminant = qb * qb - qa * qc;
    if (discriminant <= 0.0) {
      high = -1.0;
      return;
    }
    const double root = std::sqrt(discriminant);
    low = std::max(low, (-qb - root) / qa);
    high = std::min(high, (-qb + root) / qa);
  });
  if (low >= high) return std::nullopt;
  return a + (0.5 * (low + high)) * along;
}

}  // namespace coastmesh
