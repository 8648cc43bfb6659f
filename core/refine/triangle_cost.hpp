#pragma once

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

// What the optimiser makes small in the sum: the inverse of the shape, and to a smaller part how far the area is from
// that of an equilateral triangle with edges of the length wanted. Infinite of a triangle that is turned over.
inline double costOf(const Point& a, const Point& b, const Point& c, double wanted) {
  constexpr double kSizeShare = 0.1;
  const double area = cross(b - a, c - a);  // twice it
  if (area <= 0.0) return std::numeric_limits<double>::infinity();
  const double squares = squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a);
  const double ideal = 0.5 * kRootOfThree * wanted * wanted;
  return squares / (2.0 * kRootOfThree * area) + kSizeShare * (area / ideal + ideal / area);
}

}  // namespace coastmesh
