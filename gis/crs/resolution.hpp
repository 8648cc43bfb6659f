#pragma once

#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// How near cleaning may bring to one another what the input keeps apart; lengths of the working plane.
//
// A coordinate is rounded by up to 2^-53 of itself twice: in the plane, and in the CRS of the output. A triangle whose
// least height is beyond two such steps keeps its orientation. Where two edges meet at a small angle, triangles fill
// the corner from one edge to the other, and their heights are no less than the angle's sine times an eighth of the
// shortest edge there. So that these last a hundred times the rounding, edges of a corner have to lie `grain` apart as
// far from it as its shortest edge reaches.
struct Resolution {
  double grain = 0;  // 2^-44 of the largest coordinate, in the plane or in the output
  double gap = 0;  // between a vertex and another, or an edge that does not end there: the snap distance, or the grain
};

// REQUIRES: one point of the CRS for each of the plane. `scale` is the largest plane length over true length, `snap`
// the snap distance in the plane.
Resolution resolutionOf(const std::vector<Point>& plane, const std::vector<Point>& input, const Crs& crs, double scale,
                        double snap);

// Of a graph that is already in the plane, and was not snapped.
Resolution resolutionOf(const std::vector<Point>& plane);

}  // namespace coastmesh
