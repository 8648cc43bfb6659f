#include "core/refine/feasible_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace coastmesh {

namespace {

struct Disk {
  Point centre;
  double radius;
};

// The points that, to the left of the link edge, see it under at least the smallest angle. REQUIRES: that is above 0.
Disk petalOf(const LinkEdge& e, const PetalShape& petal) {
  const Point d = e.y - e.x;
  const Point mid = midpoint(e.x, e.y);
  return {{mid.x - petal.height * d.y, mid.y + petal.height * d.x}, petal.radius * std::sqrt(squaredLength(d))};
}

Point turned(const Point& d, double cosine, double sine) {
  return {cosine * d.x - sine * d.y, sine * d.x + cosine * d.y};
}

// Calls `half_plane(on, direction)` for every line that bounds the region; the region lies to its left. Stops if it
// returns false.
template <typename F>
bool forEachHalfPlane(std::span<const LinkEdge> link, const TriangleBound& bound, F&& half_plane) {
  const bool upper = bound.max_angle < std::numbers::pi - 2.0 * bound.min_angle;
  const double sin_max = upper ? std::sin(bound.max_angle) : 0.0;
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
void forEachDisk(std::span<const LinkEdge> link, const TriangleBound& bound, const PetalShape& petal, F&& disk) {
  for (const LinkEdge& e : link) {
    if (bound.min_angle > 0.0) disk(petalOf(e, petal));
    if (std::isinf(bound.squared_size)) continue;
    // Both ends, since the last corner of an open link starts no edge.
    disk(Disk{e.x, std::sqrt(bound.squared_size)});
    disk(Disk{e.y, std::sqrt(bound.squared_size)});
  }
}

// Clips a convex polygon to the left side of the line through `on` along `direction`; `clipped` and `sides` have room
// for one corner more than the polygon. Returns the number of corners left. Rounding may make a thin polygon cross the
// line more than twice: that adds no corners.
std::size_t clip(Point*& polygon, std::size_t corners, Point*& clipped, double* sides, const Point& on,
                 const Point& direction) {
  bool cut = false;
  for (std::size_t i = 0; i < corners; ++i) {
    sides[i] = cross(direction, polygon[i] - on);
    cut |= sides[i] < 0.0;
  }
  if (!cut) return corners;
  std::size_t left = 0;
  int crossings = 0;
  double before = sides[corners - 1];
  Point last = polygon[corners - 1];
  for (std::size_t i = 0; i < corners; ++i) {
    const double here = sides[i];
    const Point p = polygon[i];
    if ((before < 0.0) != (here < 0.0) && ++crossings <= 2)
      clipped[left++] = last + (before / (before - here)) * (p - last);
    if (here >= 0.0) clipped[left++] = p;
    before = here;
    last = p;
  }
  std::swap(polygon, clipped);
  return left;
}

// By value, so that it compiles without a branch.
inline double larger(double a, double b) { return a > b ? a : b; }

// Above 0 if that angle of the triangle x, x + d, c is too small. `squared` is |d|². Over |d|, each is the distance of
// c to the constraint, approximately for the petal.
struct Lacks {
  double at_x, at_y, at_c;
};

inline Lacks lacksOf(const Point& x, const Point& d, double squared, const Point& c, const TriangleBound& bound) {
  const Point g = c - x;
  const double height = bound.cos_min * cross(d, g), along = dot(d, g);
  return {bound.sin_min * along - height, bound.sin_min * (squared - along) - height,
          bound.sin_min * (squaredLength(g) - along) - height};
}

Point centreOf(const Point* polygon, std::size_t corners) {
  Point sum;
  for (std::size_t i = 0; i < corners; ++i) sum = sum + polygon[i];
  return (1.0 / static_cast<double>(corners)) * sum;
}

}  // namespace

// Every cut adds at most one corner.
void FeasibleRegion::makeRoom(std::size_t corners) {
  if (polygon_.size() >= corners) return;
  polygon_.resize(corners);
  clipped_.resize(corners);
  sides_.resize(corners);
}

bool FeasibleRegion::isForSmallestAnglesAlone() const {
  return bound_.min_angle > 0.0 && bound_.max_angle >= std::numbers::pi - 2.0 * bound_.min_angle &&
         std::isinf(bound_.squared_size);
}

FeasibleRegion::Look FeasibleRegion::look(std::span<const LinkEdge> link) {
  if (bound_.min_angle <= 0.0) return {};
  if (edges_.size() < link.size()) edges_.resize(link.size());
  PetalBox box;
  for (std::size_t i = 0; i < link.size(); ++i) box.cut(ready(link[i].x, link[i].y, edges_[i]));
  return look(std::span(edges_.data(), link.size()), box);
}

FeasibleRegion::Look FeasibleRegion::look(std::span<LookEdge> edges, const PetalBox& box) {
  const auto& [low, high] = box;
  if (box.isEmpty()) return {std::nullopt, true};
  constexpr std::size_t kMostCuts = 12;
  makeRoom(4 + kMostCuts);
  Point *polygon = polygon_.data(), *clipped = clipped_.data();
  double* sides = sides_.data();
  std::size_t corners = 4;
  polygon[0] = low;
  polygon[1] = {high.x, low.y};
  polygon[2] = high;
  polygon[3] = {low.x, high.y};
  for (LookEdge& e : edges) e.inverse = 1.0 / e.squared;
  // Cuts by the constraint that the centre of the remaining polygon violates most.
  for (std::size_t cuts = 0; cuts < kMostCuts; ++cuts) {
    const Point c = centreOf(polygon, corners);
    double worst = 0.0;
    const LookEdge* worst_edge = nullptr;
    for (const LookEdge& e : edges) {
      const Lacks lacks = lacksOf(e.from, e.along, e.squared, c, bound_);
      const double lack = larger(larger(lacks.at_x, lacks.at_y), larger(lacks.at_c, 0.0));
      const double share = lack * lack * e.inverse;
      worst_edge = share > worst ? &e : worst_edge;
      worst = larger(worst, share);
    }
    if (worst_edge == nullptr) return {c, false};
    const Point x = worst_edge->from, y = worst_edge->to, d = worst_edge->along;
    const Lacks lacks = lacksOf(x, d, worst_edge->squared, c, bound_);
    if (lacks.at_x >= lacks.at_y && lacks.at_x >= lacks.at_c) {
      corners = clip(polygon, corners, clipped, sides, x, turned(d, bound_.cos_min, bound_.sin_min));
    } else if (lacks.at_y >= lacks.at_c) {
      corners = clip(polygon, corners, clipped, sides, y, turned(d, bound_.cos_min, -bound_.sin_min));
    } else {
      const Disk petal = petalOf({x, y}, petal_);
      const Point outward = c - petal.centre;
      const Point on = petal.centre + (petal.radius / std::sqrt(squaredLength(outward))) * outward;
      corners = clip(polygon, corners, clipped, sides, on, {-outward.y, outward.x});
    }
    if (corners < 3) return {std::nullopt, true};
  }
  return {};
}

std::optional<Point> FeasibleRegion::findPoint(std::span<const LinkEdge> link) {
  if (isForSmallestAnglesAlone()) return look(link).point;
  Point low = link.front().x, high = link.front().x;
  for (const LinkEdge& e : link) {
    low = {std::min(low.x, e.x.x), std::min(low.y, e.x.y)};
    high = {std::max(high.x, e.x.x), std::max(high.y, e.x.y)};
  }
  forEachDisk(link, bound_, petal_, [&](const Disk& d) {
    low = {std::max(low.x, d.centre.x - d.radius), std::max(low.y, d.centre.y - d.radius)};
    high = {std::min(high.x, d.centre.x + d.radius), std::min(high.y, d.centre.y + d.radius)};
  });
  if (low.x >= high.x || low.y >= high.y) return std::nullopt;
  constexpr std::size_t kMostCuts = 12;
  makeRoom(4 + 4 * link.size() + kMostCuts);
  Point *polygon = polygon_.data(), *clipped = clipped_.data();
  std::size_t corners = 4;
  polygon[0] = low;
  polygon[1] = {high.x, low.y};
  polygon[2] = high;
  polygon[3] = {low.x, high.y};
  const auto cut = [&](const Point& on, const Point& direction) {
    corners = clip(polygon, corners, clipped, sides_.data(), on, direction);
    return corners >= 3;
  };
  if (!forEachHalfPlane(link, bound_, cut)) return std::nullopt;

  for (std::size_t cuts = 0; cuts < kMostCuts; ++cuts) {
    const Point c = centreOf(polygon, corners);
    double worst = 0.0;
    Disk broken{};
    forEachDisk(link, bound_, petal_, [&](const Disk& d) {
      const double excess = squaredDistance(c, d.centre) - d.radius * d.radius;
      if (excess <= worst) return;
      worst = excess;
      broken = d;
    });
    if (worst == 0.0) return c;
    const Point outward = c - broken.centre;
    const Point on = broken.centre + (broken.radius / std::sqrt(squaredLength(outward))) * outward;
    if (!cut(on, {-outward.y, outward.x})) return std::nullopt;
  }
  return std::nullopt;
}

std::optional<Point> FeasibleRegion::findPointBetween(const Point& a, const Point& b,
                                                      std::span<const LinkEdge> link) const {
  const Point along = b - a;
  double low = 0.0, high = 1.0;
  forEachHalfPlane(link, bound_, [&](const Point& on, const Point& direction) {
    // cross(direction, a + s along - on) >= 0
    const double at_a = cross(direction, a - on), slope = cross(direction, along);
    if (slope > 0.0) low = std::max(low, -at_a / slope);
    if (slope < 0.0) high = std::min(high, -at_a / slope);
    if (slope == 0.0 && at_a < 0.0) high = -1.0;
    return low < high;
  });
  forEachDisk(link, bound_, petal_, [&](const Disk& d) {
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
