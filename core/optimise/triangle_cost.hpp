#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "core/point.hpp"

namespace coastmesh {

inline constexpr double kRootOfThree = 1.7320508075688772;

// 4√3 area / Σ edge²: 1 of an equilateral triangle, 0 of a flat one, below 0 of one that is turned over.
inline double shapeOf(const Point& a, const Point& b, const Point& c) {
  return 2.0 * kRootOfThree * cross(b - a, c - a) /
         (squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a));
}

// To which part sizes count in what follows, and the least that it can be.
inline constexpr double kSizeShare = 0.1, kLeastTriangleCost = 1.0 + 2.0 * kSizeShare;

// What the optimiser makes small in the sum: the inverse of the shape, and to a smaller part how far the area is from
// that of an equilateral triangle with edges of the length wanted. Infinite of a triangle that is turned over.
inline double costOf(const Point& a, const Point& b, const Point& c, double wanted) {
  const double area = cross(b - a, c - a);  // twice it
  if (area <= 0.0) return std::numeric_limits<double>::infinity();
  const double squares = squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a);
  const double ideal = 0.5 * kRootOfThree * wanted * wanted;
  return squares / (2.0 * kRootOfThree * area) + kSizeShare * (area / ideal + ideal / area);
}

// The cotangent of the angle at p of a triangle p, a, b, counter-clockwise.
inline double cotAt(const Point& p, const Point& a, const Point& b) { return dot(a - p, b - p) / cross(a - p, b - p); }

// The cotangent of the largest angle: below 0 of an obtuse triangle.
inline double centrednessOf(const Point& a, const Point& b, const Point& c) {
  return std::min({cotAt(a, b, c), cotAt(b, c, a), cotAt(c, a, b)});
}

// How far apart the circumcentres of the triangles beside the edge from p to q are, over half the sum of the square
// roots of their areas; below 0 where they have changed sides. D-Flow FM calls a link below 0.1 small.
inline double linkShareOf(const Point& p, const Point& q, const Point& left, const Point& right) {
  const double length = 0.5 * distance(p, q) * (cotAt(left, p, q) + cotAt(right, q, p));
  const double roots = std::sqrt(0.5 * cross(q - p, left - p)) + std::sqrt(0.5 * cross(p - q, right - q));
  return length / (0.5 * roots);
}

}  // namespace coastmesh
