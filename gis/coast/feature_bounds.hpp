#pragma once

#include "gis/coast/coastline.hpp"
#include "gis/crs/crs.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// The box of all parts of a feature: rings, lines and points, in the input's CRS.
Box boundsOf(const Feature& feature);

// The number of points of its rings and lines: a measure of the work.
std::size_t pointsOf(const Feature& feature);

// The box of all frames; empty if there are none.
Box boundsOfFrames(const Coastline& coastline);

// True if two boxes of that CRS meet; longitudes may be a full turn apart.
bool meetAtAnyTurn(const Box& a, const Box& b, const Crs& crs);

}  // namespace coastmesh
