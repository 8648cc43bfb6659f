#pragma once

#include <cmath>

namespace coastmesh {

// A point or a vector in space.
struct SpacePoint {
  double x = 0.0, y = 0.0, z = 0.0;
};

inline SpacePoint operator+(const SpacePoint& a, const SpacePoint& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline SpacePoint operator-(const SpacePoint& a, const SpacePoint& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline SpacePoint operator*(double s, const SpacePoint& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const SpacePoint& a, const SpacePoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline SpacePoint cross(const SpacePoint& a, const SpacePoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double lengthOf(const SpacePoint& a) { return std::sqrt(dot(a, a)); }
inline double distance(const SpacePoint& a, const SpacePoint& b) { return lengthOf(b - a); }

}  // namespace coastmesh
