#include "core/metric.hpp"

namespace coastmesh {

// By the law of cosines: lengths of chords are known to rounding, however short they are.
bool isBadOnSphere(const Point& a, const Point& b, const Point& c, const TriangleBound& bound) {
  const Surface& surface = bound.surface;
  const double wa = surface.shrinkAt(a), wb = surface.shrinkAt(b), wc = surface.shrinkAt(c);
  const double la = squaredDistance(b, c) * wb * wc, lb = squaredDistance(c, a) * wc * wa,
               lc = squaredDistance(a, b) * wa * wb;
  const double longest = std::max({la, lb, lc}), shortest = std::min({la, lb, lc});
  const double slack = surface.margin * std::sqrt(longest);
  const double twice_at_least =
      la + lb + lc - 2.0 * shortest;  // two sides and the cosine between them, where it is least
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
