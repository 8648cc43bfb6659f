#pragma once

#include <ogr_spatialref.h>

#include "gis/crs/crs.hpp"

namespace coastmesh {

// The CRS that `srs` stands for; a plane for null. Looks for the EPSG code where the source gave none, as the WKT of a
// .prj file never does.
Crs fromOgr(const OGRSpatialReference* srs);

}  // namespace coastmesh
