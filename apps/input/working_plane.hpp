#pragma once

#include <string>

#include "gis/coast/coastline.hpp"
#include "gis/crs/crs.hpp"
#include "gis/geometry/box.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// The CRS that `--crs` names. Throws OptionError if it is unknown.
Crs parseWorkingCrs(const std::string& text);

// A warning if the plane distorts shapes in the domain, empty if it is all but conformal there; `chosen` leads into the
// plane.
std::string judgeWorkingPlane(const Coastline& coastline, const Crs& working, const Projection& chosen);

// A warning if a box of longitudes and latitudes crosses the antimeridian and the plane is cut there, empty otherwise.
std::string judgeBoxInPlane(const Box& box, const Crs& input, const Crs& working, const Projection& chosen);

}  // namespace coastmesh
