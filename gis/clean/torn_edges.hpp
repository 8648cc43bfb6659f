#pragma once

#include <span>
#include <string>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// A ring or a line of the input, and its points in the working plane.
struct ProjectedChain {
  std::string owner;  // name for error messages
  std::span<const Point> points, plane;
  bool closed = false;
};

// Throws InputError, with the edge, if `projection` maps the two ends of an edge far apart although they are close in
// the input's coordinates: a user's CRS may have a discontinuity where the input has none, at ±180 or at the edge of an
// interrupted map. `extent` is the size of the image of all chains: a discontinuity spans a large part of it.
void requireUntorn(const ProjectedChain& chain, double extent, const Crs& crs, const Projection& projection);

}  // namespace coastmesh
