#pragma once

#include "core/point.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/crs/crs.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// The distortion of shapes at a place by a plane that is not conformal.
struct Distortion {
  double ratio = 1.0;    // the largest scale of a direction over the smallest, 1 or more
  double degrees = 0.0;  // the largest difference of an angle from that on the ground
  Point place{};         // in the input's CRS
};

// The largest distortion at some thousand places on the shores, lines and frames of the domain, also within long edges.
// `to_crs` projects from the CRS of `coastline` to `crs`. REQUIRES: neither is a plane.
Distortion largestDistortion(const Coastline& coastline, const Crs& crs, const Projection& to_crs);

}  // namespace coastmesh
