#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/metric.hpp"
#include "core/size/size_box.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// Lengths and areas on the surface, from coordinates in its plane. For a plane they are the plane's, bit for bit.

// Convert the straight distance in space to the length of the shortest path on the surface, and back. No arc is longer
// than half a great circle.
inline double arcOfChord(const Surface& surface, double chord) {
  if (!surface.isCurved()) return chord;
  const double per_length = std::sqrt(surface.curvature);
  return std::asin(std::min(1.0, chord * per_length)) / per_length;
}
inline double chordOfArc(const Surface& surface, double arc) {
  if (!surface.isCurved()) return arc;
  const double per_length = std::sqrt(surface.curvature);
  return std::sin(std::min(0.5 * std::numbers::pi, arc * per_length)) / per_length;
}
inline double arcBetween(const Surface& surface, const Point& a, const Point& b) {
  return arcOfChord(surface, surface.chord(a, b));
}

// The bounds of length on the surface over length in the plane within a square.
struct ShrinkRange {
  double low = 1.0, high = 1.0;
};

inline ShrinkRange shrinkIn(const Surface& surface, const SizeBox& box) {
  if (!surface.isCurved()) return {};
  const double x = std::abs(box.centre.x), y = std::abs(box.centre.y);
  return {surface.shrinkAt({x + box.half, y + box.half}),
          surface.shrinkAt({std::max(x - box.half, 0.0), std::max(y - box.half, 0.0)})};
}

// An upper bound of a square's longest side, on the surface.
inline double longestSide(const Surface& surface, const SizeBox& box) {
  return 2.0 * box.half * shrinkIn(surface, box).high;
}
// True if the scale within a square varies by more than this factor.
inline bool isStretched(const Surface& surface, const SizeBox& box, double most) {
  const ShrinkRange shrink = shrinkIn(surface, box);
  return shrink.high > most * shrink.low;
}

// The area of a rectangle of the plane, given by two corners.
double areaOn(const Surface& surface, const Point& low, const Point& high);
inline double areaOn(const Surface& surface, const SizeBox& box) {
  return areaOn(surface, box.centre - Point{box.half, box.half}, box.centre + Point{box.half, box.half});
}

}  // namespace coastmesh
