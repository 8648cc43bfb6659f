#pragma once

#include <string>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// True if the coordinates of `crs` mirror the ground at `place`, as axes south and west do: a ring that is
// counter-clockwise on the ground is clockwise in them. False for planes, for longitudes and latitudes, and if `place`
// has no image.
bool mirrorsGround(const Crs& crs, const Point& place);

// What to use instead of such a CRS: "EPSG:5514, which has axes east and north", or without a code if none is known.
std::string unmirrored(const Crs& crs);

}  // namespace coastmesh
