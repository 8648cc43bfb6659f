#pragma once

#include <cmath>

#include "core/point.hpp"

namespace coastmesh {

// The surface that a plane stands for: the plane itself, or a sphere that is mapped to it stereographically, scale 1 at
// the origin. Topology is decided in the plane, by exact tests: circles are circles on both. Lengths, angles and areas
// are those of the sphere: of chords, and of the flat triangles between them.
struct Surface {
  double curvature = 0.0;  // 1 / (2 R)² of a sphere with the radius R, in plane units; 0: the plane
  // Where the sphere itself stands for another surface, an ellipsoid: by how much an angle there may differ, in radians
  // for each unit of the triangle's longest edge.
  double margin = 0.0;

  static Surface sphere(double radius, double margin = 0.0) { return {0.25 / (radius * radius), margin}; }

  bool isCurved() const { return curvature > 0.0; }
  double radius() const { return 0.5 / std::sqrt(curvature); }  // REQUIRES: isCurved()
  // Length on the surface over length in the plane, at a place.
  double shrinkAt(const Point& x) const { return 1.0 / (1.0 + curvature * (x.x * x.x + x.y * x.y)); }
  double squaredChord(const Point& a, const Point& b) const {
    const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
    return isCurved() ? squared * (shrinkAt(a) * shrinkAt(b)) : squared;
  }
  double chord(const Point& a, const Point& b) const { return std::sqrt(squaredChord(a, b)); }

  friend bool operator==(const Surface&, const Surface&) = default;
};

// The plane as it is seen from one place of the surface: the chart about that place, by the Möbius transformation that
// turns the sphere. Lengths near the centre are those on the surface, to second order; angles between directions and
// circles are kept. Of a plane: nothing changes.
class Frame {
 public:
  Frame(const Surface& surface, const Point& centre) : centre_(centre), curvature_(surface.curvature) {}

  bool isCurved() const { return curvature_ > 0.0; }
  // On a sphere relative to the centre, in a plane as it is.
  Point to(const Point& z) const { return isCurved() ? turned(z) : z; }
  Point from(const Point& w) const { return isCurved() ? turnedBack(w) : w; }
  // On both relative to the centre.
  Point relative(const Point& z) const { return isCurved() ? turned(z) : Point{z.x - centre_.x, z.y - centre_.y}; }
  Point absolute(const Point& w) const { return isCurved() ? turnedBack(w) : Point{w.x + centre_.x, w.y + centre_.y}; }
  // Length on the surface over length in the frame, at a place of the frame.
  double shrinkAt(const Point& w) const { return 1.0 / (1.0 + curvature_ * (w.x * w.x + w.y * w.y)); }

 private:
  // Not inline: the plane's code stays as small as it is.
  Point turned(const Point& z) const;
  Point turnedBack(const Point& w) const;

  Point centre_;
  double curvature_;
};

}  // namespace coastmesh
