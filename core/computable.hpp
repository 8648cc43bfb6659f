#pragma once

#include <cmath>

#include "core/pslg.hpp"

namespace coastmesh {

// Whether a number is 0 or has a size that coordinates and distances can have, so that nothing overflows on the way.
inline bool isComputable(double value) {
  return value == 0.0 || (std::abs(value) >= kLeastDistance && std::abs(value) <= kLargestCoordinate);
}

}  // namespace coastmesh
