#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/point.hpp"
#include "core/size_function.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// Quality measures in the plane; `isBad` measures on the surface that the plane represents. Tests that decide topology
// are exact and are in core/predicates.hpp.

inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(double s, const Point& a) { return {s * a.x, s * a.y}; }
inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
inline double cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
inline double squaredLength(const Point& a) { return dot(a, a); }
inline double squaredDistance(const Point& a, const Point& b) { return squaredLength(b - a); }
inline double distance(const Point& a, const Point& b) { return std::sqrt(squaredDistance(a, b)); }
// Measured from the nearer end: the foot of the perpendicular would be rounded to the resolution of coordinates.
inline double squaredDistanceToSegment(const Point& p, const Point& a, const Point& b) {
  const Point ab = b - a, ap = p - a, bp = p - b;
  const double from_a = dot(ap, ab), from_b = -dot(bp, ab);
  if (!(from_a > 0.0)) return squaredLength(ap);
  if (!(from_b > 0.0)) return squaredLength(bp);
  const double area = cross(ab, from_a < from_b ? ap : bp);
  return area * area / squaredLength(ab);
}
// The foot of the perpendicular from p on the line through a and b. REQUIRES: a and b differ.
inline Point projectedOnLine(const Point& p, const Point& a, const Point& b) {
  return a + (dot(p - a, b - a) / squaredDistance(a, b)) * (b - a);
}
// How far along ab the point of it nearest to p lies, 0 to 1; 0 if a and b are one.
inline double shareAlongSegment(const Point& p, const Point& a, const Point& b) {
  const double square = squaredDistance(a, b);
  return square > 0.0 ? std::clamp(dot(p - a, b - a) / square, 0.0, 1.0) : 0.0;
}
inline Point nearestOnSegment(const Point& p, const Point& a, const Point& b) {
  return a + shareAlongSegment(p, a, b) * (b - a);
}
inline Point midpoint(const Point& a, const Point& b) { return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}; }
inline Point centroid(const Point& a, const Point& b, const Point& c) { return (1.0 / 3.0) * (a + b + c); }

// The angle a b c at b, in radians, 0 to pi.
inline double angleAt(const Point& b, const Point& a, const Point& c) {
  return std::atan2(std::abs(cross(a - b, c - b)), dot(a - b, c - b));
}

// Circumcentre of abc relative to a.
inline Point circumcenterOffset(const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a;
  const double bb = squaredLength(ab), cc = squaredLength(ac);
  const double scale = 0.5 / cross(ab, ac);
  return {scale * (ac.y * bb - ab.y * cc), scale * (ab.x * cc - ac.x * bb)};
}

constexpr double toRadians(double deg) { return deg * std::numbers::pi / 180.0; }
constexpr double toDegrees(double rad) { return rad * 180.0 / std::numbers::pi; }

// Bounds on a triangle's angles, in the forms that tests need. They are a millionth of a degree stricter than
// requested, so that rounding a projected coordinate does not violate them.
struct AngleBound {
  double min_angle;  // radians
  double max_angle;  // radians; pi if there is no bound
  double cos_min;
  double sin_min;
  double cot_min;
  double cos_max;

  AngleBound(double min_angle_deg, double max_angle_deg)
      : min_angle(min_angle_deg <= 0.0 ? 0.0 : toRadians(min_angle_deg + kMarginDeg)),
        max_angle(max_angle_deg >= 180.0 ? std::numbers::pi : toRadians(max_angle_deg - kMarginDeg)),
        cos_min(std::cos(min_angle)),
        sin_min(std::sin(min_angle)),
        cot_min(cos_min / sin_min),
        cos_max(std::cos(max_angle)) {}

  static constexpr double kMarginDeg = 1e-6;

  // True if an input angle (radians) can be divided into angles within the bounds.
  bool canDivide(double angle) const {
    const double largest = std::min(max_angle, std::numbers::pi - 2.0 * min_angle);
    const double pieces = std::max(1.0, std::ceil(angle / largest - 1e-9));
    return angle >= pieces * min_angle - 1e-9;
  }
};

// Bounds on every triangle: on its angles, and on the length of its edges, measured on the surface.
struct TriangleBound : AngleBound {
  double squared_size;                 // longest edge, squared; infinite if there is no bound
  const SizeFunction* size = nullptr;  // requested lengths; null if there are none
  double longest_share = 0.0;          // longest edge as a share of the requested length at the triangle's centroid
  Surface surface;                     // represented by the plane

  TriangleBound(double min_angle_deg, double max_angle_deg, double size_max)
      : AngleBound(min_angle_deg, max_angle_deg), squared_size(size_max * size_max) {}

  // With requested lengths as well.
  TriangleBound(double min_angle_deg, double max_angle_deg, double size_max, const SizeFunction* wanted, double share)
      : TriangleBound(min_angle_deg, max_angle_deg,
                      wanted == nullptr ? size_max : std::min(size_max, share * wanted->most())) {
    size = wanted;
    longest_share = share;
  }
};

struct TriangleShape {
  double squared[3];  // squared length of edge i, opposite corner i
  unsigned shortest;  // index of the shortest edge; the first if several are equal
  unsigned longest;

  TriangleShape(const Point& a, const Point& b, const Point& c, const Surface& surface = {})
      : squared{surface.squaredChord(b, c), surface.squaredChord(c, a), surface.squaredChord(a, b)} {
    shortest = squared[0] <= squared[1] ? (squared[0] <= squared[2] ? 0 : 2) : (squared[1] <= squared[2] ? 1 : 2);
    longest = squared[0] >= squared[1] ? (squared[0] >= squared[2] ? 0 : 2) : (squared[1] >= squared[2] ? 1 : 2);
  }

  // The cosine of the angle at corner i.
  double cosAt(unsigned i) const {
    const unsigned j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
    return (squared[j] + squared[k] - squared[i]) / (2.0 * std::sqrt(squared[j] * squared[k]));
  }
};

// True if cot(smallest angle) exceeds the bound. Uses no square roots, divisions or branches: the smallest angle has
// the largest scalar product of its sides, and the cross product, twice the area, is the same at every corner.
inline bool isSmallestAngleBelow(const Point& a, const Point& b, const Point& c, double cot_min) {
  const Point ab = b - a, bc = c - b, ca = a - c;
  const double at_a = -dot(ab, ca), at_b = -dot(ab, bc), at_c = -dot(bc, ca);
  const double more = at_a > at_b ? at_a : at_b;
  const double most = more > at_c ? more : at_c;
  return most > cot_min * std::abs(cross(ab, ca));
}

// True if cos(largest angle) is below the bound. Uses the product of the two edges at that corner, since squared
// lengths cancel in needle-shaped triangles.
inline bool isLargestAngleAbove(const Point& a, const Point& b, const Point& c, double cos_max) {
  const Point ab = b - a, bc = c - b, ca = a - c;
  const double la = squaredLength(bc), lb = squaredLength(ca), lc = squaredLength(ab);
  if (la >= lb && la >= lc) return -dot(ab, ca) < cos_max * std::sqrt(lb * lc);
  if (lb >= lc) return -dot(ab, bc) < cos_max * std::sqrt(la * lc);
  return -dot(bc, ca) < cos_max * std::sqrt(la * lb);
}

inline bool isLongerThanWanted(const Point& a, const Point& b, const Point& c, double squared_longest,
                               const TriangleBound& bound) {
  const double longest = bound.longest_share * bound.size->at(centroid(a, b, c));
  return squared_longest > longest * longest;
}

// On a sphere, measured in the frame at p, where the segment is taken as straight: correct to second order if it is
// near. It is always less than half a sphere away.
double distanceToSegment(const Surface& surface, const Point& p, const Point& a, const Point& b);

// Area of the flat triangle between points of the surface; never negative on a sphere, signed in the plane.
double areaOn(const Surface& surface, const Point& a, const Point& b, const Point& c);

// True if the longest edge of a triangle, given squared, exceeds the bounds.
inline bool isTooLong(const Point& a, const Point& b, const Point& c, double squared_longest,
                      const TriangleBound& bound) {
  if (squared_longest > bound.squared_size) return true;
  return bound.size != nullptr && isLongerThanWanted(a, b, c, squared_longest, bound);
}

// `isBad` on a sphere, for the flat triangle between the points there.
bool isBadOnSphere(const Point& a, const Point& b, const Point& c, const TriangleBound& bound);

// True if a triangle misses the bounds.
inline bool isBad(const Point& a, const Point& b, const Point& c, const TriangleBound& bound) {
  if (bound.surface.isCurved()) return isBadOnSphere(a, b, c, bound);
  if (bound.min_angle > 0.0 && isSmallestAngleBelow(a, b, c, bound.cot_min)) return true;
  if (bound.max_angle < std::numbers::pi && isLargestAngleAbove(a, b, c, bound.cos_max)) return true;
  if (std::isinf(bound.squared_size)) return false;
  const double longest = std::max({squaredDistance(a, b), squaredDistance(b, c), squaredDistance(c, a)});
  return isTooLong(a, b, c, longest, bound);
}

}  // namespace coastmesh
