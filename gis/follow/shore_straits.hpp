#pragma once

#include <vector>

#include "gis/follow/shore_triangles.hpp"
#include "gis/projection/scale_table.hpp"

namespace coastmesh {

// Closed water, whose ends remain and are connected some other way.
struct ClosedStrait {
  Point place;            // in its middle
  double length_m = 0.0;  // from end to end
  double width_m = 0.0;   // the least, approximately
};

// For each patch of former water that is now land, the longest way through it between places of the same water, if at
// least two elements long.
std::vector<ClosedStrait> closedStraits(const ShoreTriangles& triangles, const ScaleTable& scales);

}  // namespace coastmesh
