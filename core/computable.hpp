#pragma once

#include <cmath>

#include "core/pslg.hpp"

namespace coastmesh {

// True if a number is 0 or in the range of coordinates and distances, so that nothing overflows later.
inline bool isComputable(double value) {
  return value == 0.0 || (std::abs(value) >= kLeastDistance && std::abs(value) <= kLargestCoordinate);
}

}  // namespace coastmesh
