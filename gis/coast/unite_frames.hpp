#pragma once

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Unites frames of several features that overlap, or touch along a line: the first feature gets the union, the others
// nothing. Otherwise their sides inside the union would become edges of the mesh. Uses coordinates only: frames on both
// sides of the antimeridian stay separate. Throws InputError if GEOS cannot unite them, or GDAL was built without it.
void uniteFrames(Coastline& coastline);

}  // namespace coastmesh
