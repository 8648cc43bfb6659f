#pragma once

#include <cmath>
#include <numbers>

#include "core/pslg.hpp"
#include "core/sphere/sphere_place.hpp"

namespace coastmesh::testing {

inline const Surface kEarth = Surface::sphere(6.371e6);

// A ring of places at an angle from the point at infinity; the domain is all but what is around that point.
inline Pslg oceanAround(double from_infinity_deg, VertexId corners = 9) {
  Pslg pslg;
  const double angle = from_infinity_deg * std::numbers::pi / 180.0;
  for (VertexId i = 0; i < corners; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / corners + 0.1;
    pslg.points.push_back(
        planeOf({std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), -std::cos(angle)}, kEarth));
    pslg.segments.push_back({i, (i + 1) % corners});
  }
  return pslg;
}

// The solid angle of a triangle (van Oosterom and Strackee 1983).
inline double solidAngle(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  return 2.0 * std::atan2(dot(a, cross(b, c)), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

}  // namespace coastmesh::testing
