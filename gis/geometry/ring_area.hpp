#pragma once

#include <cstddef>
#include <span>

#include "core/metric.hpp"
#include "core/point.hpp"

namespace coastmesh {

// Above 0 for a counter-clockwise ring. An edge from the last point to the first closes the ring.
inline double signedAreaOf(std::span<const Point> ring) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) twice += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  return 0.5 * twice;
}

}  // namespace coastmesh
