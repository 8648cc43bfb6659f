#pragma once

#include <cmath>

#include "core/point.hpp"

namespace coastmesh {

// The surface that a plane represents: the plane itself, or a sphere in stereographic projection with scale 1 at the
// origin. Topology is decided in the plane, by exact tests: circles are circles on both. Lengths, angles and areas are
// those of the sphere: of chords, and of the flat triangles between them.
struct Surface {
  double curvature = 0.0;  // 1 / (2 R)² of a sphere with the radius R, in plane units; 0: the plane
  // If the sphere approximates another surface, an ellipsoid: the largest difference between an angle here and there,
  // in radians per unit of the triangle's longest edge.
  double margin = 0.0;

  static Surface sphere(double radius, double margin = 0.0) { return {0.25 / (radius * radius), margin}; }

  bool isCurved() const { return curvature > 0.0; }
  double radius() const { return 0.5 / std::sqrt(curvature); }  // REQUIRES: isCurved()
  // The scale factor at a place: length on the surface over length in the plane.
  double shrinkAt(const Point& x) const { return 1.0 / (1.0 + curvature * (x.x * x.x + x.y * x.y)); }
  double squaredChord(const Point& a, const Point& b) const {
    const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
    return isCurved() ? squared * (shrinkAt(a) * shrinkAt(b)) : squared;
  }
  double chord(const Point& a, const Point& b) const { return std::sqrt(squaredChord(a, b)); }

  friend bool operator==(const Surface&, const Surface&) = default;
};

// The plane as seen from one place of the surface: the chart around that place, by the Möbius transformation that
// rotates the sphere. Lengths near the centre equal those on the surface to second order; angles and circles are
// preserved. For a plane nothing changes.
class Frame {
 public:
  Frame(const Surface& surface, const Point& centre) : centre_(centre), curvature_(surface.curvature) {}

  bool isCurved() const { return curvature_ > 0.0; }
  // Relative to the centre on a sphere, unchanged in a plane.
  Point to(const Point& z) const { return isCurved() ? turned(z) : z; }
  Point from(const Point& w) const { return isCurved() ? turnedBack(w) : w; }
  // Relative to the centre on both.
  Point relative(const Point& z) const { return isCurved() ? turned(z) : Point{z.x - centre_.x, z.y - centre_.y}; }
  Point absolute(const Point& w) const { return isCurved() ? turnedBack(w) : Point{w.x + centre_.x, w.y + centre_.y}; }
  // The scale factor at a place of the frame: length on the surface over length in the frame.
  double shrinkAt(const Point& w) const { return 1.0 / (1.0 + curvature_ * (w.x * w.x + w.y * w.y)); }

 private:
  // Not inline, to keep the plane's code small.
  Point turned(const Point& z) const;
  Point turnedBack(const Point& w) const;

  Point centre_;
  double curvature_;
};

}  // namespace coastmesh
