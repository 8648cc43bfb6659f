#pragma once

#include <vector>

#include "gis/follow/shore_triangles.hpp"
#include "gis/projection/scale_table.hpp"

namespace coastmesh {

// Water that was closed, though what lies at its ends stays, joined some other way.
struct ClosedStrait {
  Point place;            // in the middle of it
  double length_m = 0.0;  // from end to end
  double width_m = 0.0;   // the narrowest, about
};

// Of what was water and is land by now: of each patch the longest way through it between places of the same water,
// where it is longer than an element or two.
std::vector<ClosedStrait> closedStraits(const ShoreTriangles& triangles, const ScaleTable& scales);

}  // namespace coastmesh
