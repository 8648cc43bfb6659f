#pragma once

#include <span>
#include <string>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// A ring or a line of the input, and where its points lie in the working plane.
struct ProjectedChain {
  std::string owner;  // as errors name it
  std::span<const Point> points, plane;
  bool closed = false;
};

// Throws InputError, with the edge, where `projection` shows the two ends of an edge far apart that the input's
// coordinates have near one another: a CRS of the user's choice may be torn where the input is not, at ±180 or along
// the edge of an interrupted map. `extent` is that of the whole plane: a tear reaches through a good part of it.
void requireUntorn(const ProjectedChain& chain, double extent, const Crs& crs, const Projection& projection);

}  // namespace coastmesh
