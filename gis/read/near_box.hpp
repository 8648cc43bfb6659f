#pragma once

#include <cstdint>

#include "gis/geometry/box.hpp"
#include "gis/read/open_source.hpp"

namespace coastmesh {

// Limits the source to features whose boxes meet `box` (west, south, east, north in degrees; an east less than the west
// is beyond the antimeridian) or its surroundings, and returns how many that excludes: as many as framing by that box
// would, or fewer. Does nothing unless this is known without reading the features: one layer of polygons in longitudes
// from -180 to 180, of a GeoPackage with a spatial index.
std::uint64_t keepNear(const OpenSource& source, const Box& box);

// Undoes it.
void keepAll(const OpenSource& source);

}  // namespace coastmesh
