#pragma once

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Makes the frames of several features that overlap, or touch along a line, one: the first of them gets what they cover
// together, and the others nothing. Their sides inside of it would be edges of the mesh. By coordinates: frames on both
// sides of the antimeridian stay apart. Throws InputError: GEOS cannot unite them, or GDAL is without it.
void uniteFrames(Coastline& coastline);

}  // namespace coastmesh
