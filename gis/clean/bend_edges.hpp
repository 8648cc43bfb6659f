#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// Which line between its two points an edge of the input stands for.
enum class EdgeLine {
  Plane,     // straight in the working plane
  LonLat,    // straight in the input's coordinates
  Geodesic,  // the shortest way on the ellipsoid
};
inline constexpr std::array kEdgeLineNames{"plane", "lonlat", "geodesic"};  // in the order of EdgeLine

// Puts points on the edges of features[members], so that straight pieces of the plane lie within `tolerance_m`, metres
// on the ground, of the lines that the edges stand for, or are shorter than that; 4,096 pieces an edge at the most.
// Points lie on the lines, in the input's coordinates, and are the same for an edge whichever way it runs. Frames are
// left alone: they are lines of the input's coordinates already. Returns how many points were put in. REQUIRES: a
// tolerance above 0, and a place on Earth.
std::size_t bendEdges(Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                      EdgeLine line, double tolerance_m);

}  // namespace coastmesh
