#pragma once

#include "core/point.hpp"

namespace coastmesh {

// The intersection of the segments ab and cd: accurate to about 100 bits of their extent, then rounded to the nearest
// doubles, the same on every machine. It is in the boxes of both, and so exactly on an axis-parallel segment. Segments
// that are parallel to within these bits intersect at b. REQUIRES: they cross properly; coordinates are `isComputable`.
Point crossingPoint(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace coastmesh
