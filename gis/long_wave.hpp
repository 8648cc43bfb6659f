#pragma once

#include <cmath>

namespace coastmesh {

inline constexpr double kGravity = 9.81;  // m/s2, as ADCIRC, SCHISM, FVCOM and TELEMAC have it

// How fast a wave much longer than the depth goes: metres a second, of metres above 0.
inline double longWaveSpeed(double depth_m) { return std::sqrt(kGravity * depth_m); }

}  // namespace coastmesh
