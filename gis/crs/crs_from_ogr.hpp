#pragma once

#include <ogr_spatialref.h>

#include "gis/crs/crs.hpp"

namespace coastmesh {

// The CRS of `srs`; a plane for null. Looks up the EPSG code if the source has none, as in the WKT of a .prj
// file.
Crs fromOgr(const OGRSpatialReference* srs);

}  // namespace coastmesh
