#pragma once

#include <array>

namespace coastmesh {

// The surface on which lengths, angles and areas are measured.
enum class SurfaceKind {
  Auto,       // the ellipsoid for domains larger than a cap of 30 degrees, otherwise the working plane
  Plane,      // the working plane
  Ellipsoid,  // that of the input's CRS
  Sphere,     // the sphere of models that treat latitudes as spherical
};

inline constexpr std::array kSurfaceNames{"auto", "plane", "ellipsoid", "sphere"};  // in the order of SurfaceKind

// The radius of that sphere, metres: the Earth's mean radius.
inline constexpr double kSphereRadius = 6371008.8;

}  // namespace coastmesh
