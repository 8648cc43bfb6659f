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

// The cost of a triangle, and its parts.
struct TriangleCost {
  double cost;
  double flatness;    // Σ edge² over twice the area: 2 √3 for an equilateral triangle
  double area_share;  // of an equilateral triangle of the requested length
};

// The cost whose sum the optimiser reduces: the inverse of the shape, and with a smaller weight the deviation of the
// area from that of an equilateral triangle of the requested length. Arguments: twice the area (`doubled`), above 0,
// and the sum of the squared edges. A single division: they take longer than the rest.
inline TriangleCost costWithParts(double doubled, double squares, double wanted) {
  const double ideal = 0.5 * kRootOfThree * wanted * wanted, inverse = 1.0 / (doubled * ideal);
  const double flatness = squares * (ideal * inverse), area_share = doubled * (doubled * inverse);
  return {flatness * (0.5 / kRootOfThree) + kSizeShare * (area_share + ideal * (ideal * inverse)), flatness,
          area_share};
}
inline double costOf(double doubled, double squares, double wanted) {
  return costWithParts(doubled, squares, wanted).cost;
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

// True if that is certainly at least `share`, without square roots; false means unknown. By (√a + √b)² ≤ 2 (a + b).
inline bool isLinkClearOf(double share, const Point& p, const Point& q, const Point& left, const Point& right) {
  const double at_left = cross(p - left, q - left), at_right = cross(q - right, p - right);
  if (at_left <= 0.0 || at_right <= 0.0) return false;
  const double cotangents = dot(p - left, q - left) / at_left + dot(q - right, p - right) / at_right;
  return cotangents > 0.0 && squaredDistance(p, q) * cotangents * cotangents > share * share * (at_left + at_right);
}

}  // namespace coastmesh
