#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// The line between its end points that an edge of the input represents.
enum class EdgeLine {
  Plane,     // straight in the working plane
  LonLat,    // straight in the input's coordinates
  Geodesic,  // the shortest path on the ellipsoid
};
inline constexpr std::array kEdgeLineNames{"plane", "lonlat", "geodesic"};  // in the order of EdgeLine

// Adds points to the edges of features[members], so that straight pieces in the plane are within `tolerance_m`, metres
// on the ground, of the lines that the edges represent, or shorter than that; at most 4,096 pieces per edge. Points lie
// on the lines, in the input's coordinates, and do not depend on the direction of the edge. Skips frames, which are
// divided along lines of the input's coordinates already, and features of cleaned files. Returns the number of points
// added. REQUIRES: a tolerance above 0, and a place on Earth.
std::size_t bendEdges(Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                      EdgeLine line, double tolerance_m);

}  // namespace coastmesh
