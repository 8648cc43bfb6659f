#pragma once

#include "gis/read/open_source.hpp"

namespace coastmesh {

// Throws InputError if the member `crs` of a GeoJSON file names a CRS that PROJ does not know: OGR then takes the
// coordinates for longitudes and latitudes on WGS 84 silently.
void requireKnownCrs(const OpenSource& source);

}  // namespace coastmesh
