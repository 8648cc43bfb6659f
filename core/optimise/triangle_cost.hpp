#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "core/point.hpp"

namespace coastmesh {

inline constexpr double kRootOfThree = 1.7320508075688772;

// 4√3 area / Σ edge²: 1 for an equilateral triangle, 0 for a flat one, negative for an inverted one.
inline double shapeOf(const Point& a, const Point& b, const Point& c) {
  const double squares = squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a);
  return 2.0 * kRootOfThree * cross(b - a, c - a) / squares;
}

// The weight of sizes in the following cost, and its smallest possible value.
inline constexpr double kSizeShare = 0.1, kLeastTriangleCost = 1.0 + 2.0 * kSizeShare;

// The cost whose sum the optimiser reduces: the inverse of the shape, and with a smaller weight the deviation of the
// area from that of an equilateral triangle of the requested length. Arguments: Σ edge² over twice the area, and the
// ratio of the two areas and its inverse.
inline double costOfParts(double flatness, double area_share, double inverse_share) {
  return flatness * (0.5 / kRootOfThree) + kSizeShare * (area_share + inverse_share);
}

// Twice the area of an equilateral triangle.
inline double idealDoubled(double length) { return 0.5 * kRootOfThree * length * length; }

// The same from twice the area (`doubled`), above 0, and the sum of the squared edges. A single division: they take
// longer than the rest.
inline double costOf(double doubled, double squares, double wanted) {
  const double ideal = idealDoubled(wanted), inverse = 1.0 / (doubled * ideal);
  return costOfParts(squares * (ideal * inverse), doubled * (doubled * inverse), ideal * (ideal * inverse));
}

// The length requested in a triangle from those at its corners.
inline double meanOf(double a, double b, double c) { return (a + b + c) * (1.0 / 3.0); }

inline double squaresOf(const Point& a, const Point& b, const Point& c) {
  return squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a);
}

// The cost of triangle abc; infinite if it is inverted.
inline double costOf(const Point& a, const Point& b, const Point& c, double wanted) {
  const double doubled = cross(b - a, c - a);
  return doubled > 0.0 ? costOf(doubled, squaresOf(a, b, c), wanted) : std::numeric_limits<double>::infinity();
}

// The best shape of a triangle with that angle, which is isosceles.
inline double bestShapeWith(double angle) { return kRootOfThree * std::sin(angle) / (2.0 - std::cos(angle)); }

// The cotangent of the angle at p of the counter-clockwise triangle p, a, b.
inline double cotAt(const Point& p, const Point& a, const Point& b) { return dot(a - p, b - p) / cross(a - p, b - p); }

// The cotangent of the largest angle: negative for an obtuse triangle.
inline double centrednessOf(const Point& a, const Point& b, const Point& c) {
  return std::min({cotAt(a, b, c), cotAt(b, c, a), cotAt(c, a, b)});
}

// The distance of the circumcentres of the triangles beside the edge from p to q, over half the sum of the square roots
// of their areas; negative if they have changed sides. D-Flow FM calls a link below 0.1 small.
inline double linkShareOf(const Point& p, const Point& q, const Point& left, const Point& right) {
  const double length = 0.5 * distance(p, q) * (cotAt(left, p, q) + cotAt(right, q, p));
  const double roots = std::sqrt(0.5 * cross(q - p, left - p)) + std::sqrt(0.5 * cross(p - q, right - q));
  return length / (0.5 * roots);
}

// True if that is certainly at least `share`, without square roots and divisions; false means unknown. By
// (√a + √b)² ≤ 2 (a + b).
inline bool isLinkClearOf(double share, const Point& p, const Point& q, const Point& left, const Point& right) {
  const double at_left = cross(p - left, q - left), at_right = cross(q - right, p - right);
  if (at_left <= 0.0 || at_right <= 0.0) return false;
  // The sum of the cotangents, times the product of the areas.
  const double cotangents = dot(p - left, q - left) * at_right + dot(q - right, p - right) * at_left;
  const double limit = share * at_left * at_right;
  return cotangents > 0.0 && squaredDistance(p, q) * cotangents * cotangents > limit * limit * (at_left + at_right);
}

}  // namespace coastmesh
