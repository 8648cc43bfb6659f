#pragma once

#include <cmath>

namespace coastmesh {

inline constexpr double kGravity = 9.81;  // m/s2, as in ADCIRC, SCHISM, FVCOM and TELEMAC

// Speed of a wave much longer than the depth, in metres per second, for a depth in metres above 0.
inline double longWaveSpeed(double depth_m) { return std::sqrt(kGravity * depth_m); }

}  // namespace coastmesh
