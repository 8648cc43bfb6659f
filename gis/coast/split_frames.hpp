#pragma once

#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Brings frames into the 360 degrees of longitude that begin at `west`, where the data are. Rings whose longitudes jump
// (`turnsOf`) are continued past the antimeridian, those around a pole are closed through it, and polygons are split at
// the ends of the range; others are left as they are. Returns a note for each feature with a ring that jumps. Throws
// InputError if GEOS cannot split them, or GDAL was built without it. REQUIRES: the CRS is geographic.
std::vector<std::string> splitFrames(Coastline& coastline, double west);

}  // namespace coastmesh
