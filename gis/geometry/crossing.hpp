#pragma once

#include "core/point.hpp"

namespace coastmesh {

// The intersection of the segments ab and cd: accurate to about 100 bits of their extent, then rounded to the nearest
// doubles, the same on every machine. It is in the boxes of both, and so exactly on a segment along an axis. Segments
// so nearly parallel that these bits do not distinguish them intersect at b. REQUIRES: they cross properly; coordinates
// are `isComputable`.
Point crossingPoint(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace coastmesh
