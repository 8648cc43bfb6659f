#pragma once

#include "core/point.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/crs/crs.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// What a plane that is not conformal does to shapes at a place.
struct Distortion {
  double ratio = 1.0;    // the largest scale of a direction over the smallest, 1 or more
  double degrees = 0.0;  // by which an angle can differ from that on the ground
  Point place{};         // in the input's CRS
};

// The largest at some thousand places on the shores, lines and frames of the domain, between the vertices of long edges
// too. `to_crs` leads from the CRS of `coastline` to `crs`. REQUIRES: neither is a plane.
Distortion largestDistortion(const Coastline& coastline, const Crs& crs, const Projection& to_crs);

}  // namespace coastmesh
