#pragma once

#include "core/metric.hpp"
#include "core/point.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

// True if the segments ab and cd meet, which is exact, or are nearer to one another than `least`.
inline bool areNear(const Point& a, const Point& b, const Point& c, const Point& d, double least) {
  if (!Box::of(a, b).grownBy(least).meets(Box::of(c, d))) return false;
  if (segmentsMeet(a, b, c, d)) return true;
  const double squared = least * least;
  return squaredDistanceToSegment(a, c, d) < squared || squaredDistanceToSegment(b, c, d) < squared ||
         squaredDistanceToSegment(c, a, b) < squared || squaredDistanceToSegment(d, a, b) < squared;
}

}  // namespace coastmesh
