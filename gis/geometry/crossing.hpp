#pragma once

#include "core/point.hpp"

namespace coastmesh {

// Where the segments ab and cd cross: right to some 100 bits of their extent, then rounded to the nearest doubles, the
// same on every machine. It lies in the boxes of both, so on a segment along an axis exactly. Segments so nearly
// parallel that these bits do not tell them apart cross at b. REQUIRES: they cross properly; coordinates are
// `isComputable`.
Point crossingPoint(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace coastmesh
