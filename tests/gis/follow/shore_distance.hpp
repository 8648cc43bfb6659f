#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/metric.hpp"
#include "gis/clean/domain.hpp"

namespace coastmesh::testing {

// The largest distance of these points from the shores of a domain.
inline double farthestFrom(const std::vector<Point>& points, const Domain& domain) {
  double farthest = 0.0;
  for (const Point& p : points) {
    double least = 1e300;
    for (const Segment& s : domain.pslg.segments)
      least = std::min(least, squaredDistanceToSegment(p, domain.pslg.points[s.a], domain.pslg.points[s.b]));
    farthest = std::max(farthest, std::sqrt(least));
  }
  return farthest;
}

}  // namespace coastmesh::testing
