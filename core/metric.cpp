#include "core/metric.hpp"

namespace coastmesh {

double distanceToSegment(const Surface& surface, const Point& p, const Point& a, const Point& b) {
  if (!surface.isCurved()) return std::sqrt(squaredDistanceToSegment(p, a, b));
  const Frame at_p(surface, p);
  return std::sqrt(squaredDistanceToSegment({}, at_p.relative(a), at_p.relative(b)));
}

double areaOn(const Surface& surface, const Point& a, const Point& b, const Point& c) {
  if (!surface.isCurved()) return 0.5 * cross(b - a, c - a);
  const TriangleShape shape(a, b, c, surface);
  const double la = shape.squared[0], lb = shape.squared[1], lc = shape.squared[2];
  const double across = la + lb - lc;
  return 0.25 * std::sqrt(std::max(0.0, 4.0 * la * lb - across * across));
}

namespace {

// True if a triangle covers more than half of the sphere. Its chords may be as short as those of a good triangle, but
// in the plane one of its edges is long: others need no test.
bool goesRound(const Point& a, const Point& b, const Point& c, double wa, double wb, double wc,
               const Surface& surface) {
  const double longest = std::max({squaredDistance(b, c), squaredDistance(c, a), squaredDistance(a, b)});
  if (64.0 * surface.curvature * longest < 1.0) return false;
  // Relative to the sphere's centre: heights in radii, the rest in plane units.
  const double ha = 2.0 * wa - 1.0, hb = 2.0 * wb - 1.0, hc = 2.0 * wc - 1.0;
  return ha * wb * wc * cross(b, c) + hb * wc * wa * cross(c, a) + hc * wa * wb * cross(a, b) <= 0.0;
}

}  // namespace

// By the law of cosines, since the lengths of chords are accurate to rounding, however short they are.
bool isBadOnSphere(const Point& a, const Point& b, const Point& c, const TriangleBound& bound) {
  const Surface& surface = bound.surface;
  const double wa = surface.shrinkAt(a), wb = surface.shrinkAt(b), wc = surface.shrinkAt(c);
  const double la = squaredDistance(b, c) * wb * wc, lb = squaredDistance(c, a) * wc * wa,
               lc = squaredDistance(a, b) * wa * wb;
  if (goesRound(a, b, c, wa, wb, wc, surface)) return true;
  const double longest = std::max({la, lb, lc}), shortest = std::min({la, lb, lc});
  const double slack = surface.margin * std::sqrt(longest);
  const double twice_at_least = la + lb + lc - 2.0 * shortest;  // 2 b c cos A at the smallest angle A
  const double twice_at_most = la + lb + lc - 2.0 * longest;
  const double product_at_least = la * lb * lc / shortest, product_at_most = la * lb * lc / longest;
  if (bound.min_angle > 0.0) {
    const double cosine = bound.cos_min - slack * bound.sin_min;
    if (twice_at_least > 2.0 * cosine * std::sqrt(product_at_least)) return true;
  }
  if (bound.max_angle < std::numbers::pi) {
    const double cosine = bound.cos_max + slack * std::sin(bound.max_angle);
    if (twice_at_most < 2.0 * cosine * std::sqrt(product_at_most)) return true;
  }
  if (std::isinf(bound.squared_size)) return false;
  return isTooLong(a, b, c, longest, bound);
}

}  // namespace coastmesh
