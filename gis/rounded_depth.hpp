#pragma once

#include <cmath>

namespace coastmesh {

// The nearest number of at most six decimals to a depth or height in metres that was computed, as by interpolation:
// -3274 for -3274.0000000000005, never -0. No survey is exact to a micrometre. NaN stays NaN.
inline double roundedDepth(double metres) {
  constexpr double kPerMetre = 1e6;
  return std::round(metres * kPerMetre) / kPerMetre + 0.0;
}

}  // namespace coastmesh
