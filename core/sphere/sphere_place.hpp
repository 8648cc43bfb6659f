#pragma once

#include <cmath>

#include "core/point.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// From the sphere of radius 1 to the plane of a curved surface, and back: (0, 0, 1) is the origin, (0, 0, -1) the point
// at infinity.
inline Point planeOf(const SpacePoint& place, const Surface& surface) {
  // Avoids the difference of two almost equal numbers near the pole.
  const double up = place.z > 0.0 ? 1.0 + place.z : (place.x * place.x + place.y * place.y) / (1.0 - place.z);
  const double scale = 2.0 * surface.radius() / up;
  return {scale * place.x, scale * place.y};
}

inline SpacePoint placeOnSphere(const Point& x, const Surface& surface) {
  const double shrink = surface.shrinkAt(x), across = 2.0 * std::sqrt(surface.curvature) * shrink;
  return {across * x.x, across * x.y, 2.0 * shrink - 1.0};
}

}  // namespace coastmesh
