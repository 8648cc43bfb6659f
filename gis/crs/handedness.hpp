#pragma once

#include <string>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// Whether the coordinates of `crs` show the ground mirrored at `place`, as those with axes south and west do: what goes
// round counter-clockwise on the ground goes round clockwise in them. False for planes, for longitudes and latitudes,
// and where `place` lies nowhere.
bool mirrorsGround(const Crs& crs, const Point& place);

// What to use instead of a CRS that does so: "EPSG:5514, which has axes east and north", or without the code.
std::string unmirrored(const Crs& crs);

}  // namespace coastmesh
