#pragma once

#include "gis/raster/raster_band.hpp"

namespace coastmesh {

// The raster for places in that CRS: if it is geographic and the raster has no CRS, columns are longitudes, which
// `pixelOf` shifts into the raster's range.
RasterGeometry asSeenFrom(const Crs& places, RasterGeometry raster);

// The columns after which a place has the same longitude again: 360 degrees. `places` is the CRS of the places whose
// pixels are sought: see `asSeenFrom`. 0 if rows are not along parallels, if columns are not evenly spaced along them,
// and if both have the same projection.
double columnsOfTurn(const RasterGeometry& raster, const Crs& places);

}  // namespace coastmesh
