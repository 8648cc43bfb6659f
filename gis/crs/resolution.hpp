#pragma once

#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// How close cleaning may bring vertices and edges that are apart in the input; lengths of the working plane.
//
// A coordinate is rounded by up to 2^-53 of itself twice: in the plane, and in the CRS of the output. A triangle whose
// smallest height exceeds two such steps keeps its orientation. Where two edges meet at a small angle, triangles fill
// the corner from one edge to the other, and their heights are at least the angle's sine times an eighth of the
// shortest edge there. For these to be 64 times such a rounding, the edges of a corner must be `grain` apart at the
// distance of its shortest edge.
struct Resolution {
  double grain = 0;  // 2^-44 of the largest coordinate, in the plane or in the output
  double gap = 0;    // between a vertex and another, or an edge that does not end there: snap distance or grain
};

// REQUIRES: one point of the CRS for each of the plane. `scale` is the largest ratio of plane length to true length,
// `snap` the snap distance in the plane.
Resolution resolutionOf(const std::vector<Point>& plane, const std::vector<Point>& input, const Crs& crs, double scale,
                        double snap);

// For a graph that is already in the plane and was not snapped.
Resolution resolutionOf(const std::vector<Point>& plane);

}  // namespace coastmesh
