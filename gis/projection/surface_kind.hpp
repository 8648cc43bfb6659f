#pragma once

#include <array>

namespace coastmesh {

// What lengths, angles and areas are measured on.
enum class SurfaceKind {
  Auto,       // the ellipsoid for what is larger than a cap of 30 degrees, the working plane for all else
  Plane,      // the working plane
  Ellipsoid,  // that of the input's CRS
  Sphere,     // the sphere of models that take latitudes for spherical ones
};

inline constexpr std::array kSurfaceNames{"auto", "plane", "ellipsoid", "sphere"};  // in the order of SurfaceKind

// The radius of that sphere, metres: the mean one of the Earth.
inline constexpr double kSphereRadius = 6371008.8;

}  // namespace coastmesh
