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

// Above 0 if that angle of the triangle x, x + d, c is too small. `squared` is |d|². Over |d|, each is the distance of
// c to the constraint, approximately for the petal. For one triangle, or for two at once.
template <typename Number>
struct Lacks {
  Number at_x, at_y, at_c;
};

template <typename Number>
Lacks<Number> lacksOf(Number from_x, Number from_y, Number along_x, Number along_y, Number squared, const Point& c,
                      const TriangleBound& bound) {
  const Number gx = c.x - from_x, gy = c.y - from_y;
  const Number height = bound.cos_min * (along_x * gy - along_y * gx), along = along_x * gx + along_y * gy;
  return {bound.sin_min * along - height, bound.sin_min * (squared - along) - height,
          bound.sin_min * (gx * gx + gy * gy - along) - height};
}

Lacks<double> lacksOf(const LookEdge& e, const Point& c, const TriangleBound& bound) {
  return lacksOf(e.from.x, e.from.y, e.along.x, e.along.y, e.squared, c, bound);
}

// How far a place is from meeting the constraints of each edge, squared and as a share of the edge. Returns the most.
double measureLacks(std::span<const LookEdgePair> edges, const Point& c, const TriangleBound& bound,
                    std::span<DoublePair> shares) {
  DoublePair worst{};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const LookEdgePair& e = edges[i];
    const auto lacks = lacksOf(e.from_x, e.from_y, e.along_x, e.along_y, e.squared, c, bound);
    const DoublePair lack = larger(larger(lacks.at_x, lacks.at_y), larger(lacks.at_c, DoublePair{}));
    shares[i] = lack * lack * e.inverse;
    worst = larger(worst, shares[i]);
  }
  return larger(worst[0], worst[1]);
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
  edges_.clear();
  PetalBox box;
  LookEdge edge;
  for (const LinkEdge& e : link) {
    box.cut(ready(e.x, e.y, edge));
    edges_.push(edge);
  }
  return look(edges_, box);
}

// The boxes of two petals.
struct FeasibleRegion::BoxPair {
  DoublePair low_x, low_y, high_x, high_y;

  BoxPair(const LookEdgePair& e, const PetalShape& petal) {
    const DoublePair radius = petal.radius * DoublePair{std::sqrt(e.squared[0]), std::sqrt(e.squared[1])};
    const DoublePair x = 0.5 * (e.from_x + e.to_x) - petal.height * e.along_y;
    const DoublePair y = 0.5 * (e.from_y + e.to_y) + petal.height * e.along_x;
    low_x = x - radius;
    low_y = y - radius;
    high_x = x + radius;
    high_y = y + radius;
  }
  PetalBox operator[](std::size_t lane) const { return {{low_x[lane], low_y[lane]}, {high_x[lane], high_y[lane]}}; }
  void cut(const BoxPair& by) {
    low_x = larger(low_x, by.low_x);
    low_y = larger(low_y, by.low_y);
    high_x = smaller(high_x, by.high_x);
    high_y = smaller(high_y, by.high_y);
  }
};

PetalBox FeasibleRegion::boxOf(LookEdges& edges) const {
  const std::span<const LookEdgePair> pairs = edges.pairs();
  BoxPair all(pairs.front(), petal_);
  for (const LookEdgePair& e : pairs.subspan(1)) all.cut(BoxPair(e, petal_));
  PetalBox box = all[0];
  box.cut(all[1]);
  return box;
}

void FeasibleRegion::boxesOf(LookEdges& edges, std::vector<PetalBox>& boxes) const {
  const std::span<const LookEdgePair> pairs = edges.pairs();
  boxes.resize(2 * pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const BoxPair both(pairs[i], petal_);
    boxes[2 * i] = both[0];
    boxes[2 * i + 1] = both[1];
  }
  boxes.resize(edges.size());
}

FeasibleRegion::Look FeasibleRegion::look(LookEdges& edges, const PetalBox& box) {
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
  const std::span<LookEdgePair> pairs = edges.pairs();
  for (LookEdgePair& e : pairs) e.inverse = 1.0 / e.squared;
  if (shares_.size() < pairs.size()) shares_.resize(pairs.size());
  // Cuts by the constraint that the centre of the remaining polygon violates most.
  for (std::size_t cuts = 0; cuts < kMostCuts; ++cuts) {
    const Point c = centreOf(polygon, corners);
    const double most = measureLacks(pairs, c, bound_, shares_);
    if (most == 0.0) return {c, false};
    std::size_t worst = 0;
    while (worst < edges.size() && shares_[worst / 2][worst % 2] != most) ++worst;
    if (worst == edges.size()) return {};  // not a number
    const LookEdge e = edges[worst];
    const Lacks lacks = lacksOf(e, c, bound_);
    if (lacks.at_x >= lacks.at_y && lacks.at_x >= lacks.at_c) {
      corners = clip(polygon, corners, clipped, sides, e.from, turned(e.along, bound_.cos_min, bound_.sin_min));
    } else if (lacks.at_y >= lacks.at_c) {
      corners = clip(polygon, corners, clipped, sides, e.to, turned(e.along, bound_.cos_min, -bound_.sin_min));
    } else {
      const Disk petal = petalOf({e.from, e.to}, petal_);
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

bool FeasibleRegion::cut(LinePart& part, const LinkEdge& edge) const {
  const std::span<const LinkEdge> link(&edge, 1);
  forEachHalfPlane(link, bound_, [&](const Point& on, const Point& direction) {
    // cross(direction, from + s along - on) >= 0
    const double at_start = cross(direction, part.from - on), slope = cross(direction, part.along);
    if (slope > 0.0) part.low = std::max(part.low, -at_start / slope);
    if (slope < 0.0) part.high = std::min(part.high, -at_start / slope);
    if (slope == 0.0 && at_start < 0.0) part.high = -1.0;
    return !part.isEmpty();
  });
  if (part.isEmpty()) return false;
  const double qa = squaredLength(part.along);
  forEachDisk(link, bound_, petal_, [&](const Disk& d) {
    const Point offset = part.from - d.centre;
    const double qb = dot(part.along, offset), qc = squaredLength(offset) - d.radius * d.radius;
    const double discriminant = qb * qb - qa * qc;
    if (discriminant <= 0.0) {
      part.high = -1.0;
      return;
    }
    const double root = std::sqrt(discriminant);
    part.low = std::max(part.low, (-qb - root) / qa);
    part.high = std::min(part.high, (-qb + root) / qa);
  });
  return !part.isEmpty();
}

std::optional<Point> FeasibleRegion::findPointBetween(const Point& a, const Point& b,
                                                      std::span<const LinkEdge> link) const {
  LinePart part(a, b);
  for (const LinkEdge& e : link)
    if (!cut(part, e)) return std::nullopt;
  return a + (0.5 * (part.low + part.high)) * part.along;
}

}  // namespace coastmesh
