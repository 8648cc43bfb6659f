#pragma once

#include <cmath>

#include "core/point.hpp"

namespace coastmesh {

namespace detail {
// The error bounds hold unless products underflow; smaller values are left to exact arithmetic.
inline constexpr double kUnderflow = 1e-250;

int orient2dExact(const Point& a, const Point& b, const Point& c);
int inCircleExact(const Point& a, const Point& b, const Point& c, const Point& d);
}  // namespace detail

// +1 iff a, b, c turn counter-clockwise, -1 iff clockwise, 0 iff collinear; exact. Rotating the arguments keeps the
// sign, exchanging two flips it.
inline int orient2d(const Point& a, const Point& b, const Point& c) {
  // Forward error bound of Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
  // Predicates" (1997), Section 4.1, stage A.
  constexpr double kBound = 3.3306690738754716e-16;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double det = left - right;
  const double bound = kBound * (std::abs(left) + std::abs(right)) + detail::kUnderflow;
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return detail::orient2dExact(a, b, c);
}

// +1 iff d lies inside the circle through a, b, c (counter-clockwise), -1 iff outside, 0 iff on it; exact.
inline int inCircle(const Point& a, const Point& b, const Point& c, const Point& d) {
  // As above, Section 4.3, stage A.
  constexpr double kBound = 1.1102230246251577e-15;
  const double adx = a.x - d.x, ady = a.y - d.y;
  const double bdx = b.x - d.x, bdy = b.y - d.y;
  const double cdx = c.x - d.x, cdy = c.y - d.y;
  const double bdxcdy = bdx * cdy, cdxbdy = cdx * bdy;
  const double cdxady = cdx * ady, adxcdy = adx * cdy;
  const double adxbdy = adx * bdy, bdxady = bdx * ady;
  const double alift = adx * adx + ady * ady;
  const double blift = bdx * bdx + bdy * bdy;
  const double clift = cdx * cdx + cdy * cdy;
  const double det = alift * (bdxcdy - cdxbdy) + blift * (cdxady - adxcdy) + clift * (adxbdy - bdxady);
  const double permanent = alift * (std::abs(bdxcdy) + std::abs(cdxbdy)) +
                           blift * (std::abs(cdxady) + std::abs(adxcdy)) +
                           clift * (std::abs(adxbdy) + std::abs(bdxady));
  const double bound = kBound * permanent + detail::kUnderflow;
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return detail::inCircleExact(a, b, c, d);
}

}  // namespace coastmesh
