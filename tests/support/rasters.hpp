#pragma once

#include <functional>
#include <string>

#include "gis/crs/crs.hpp"

namespace coastmesh::testing {

struct RasterShape {
  int columns = 0;
  int rows = 0;
  double west = 0.0;  // left and upper edge of the raster
  double north = 0.0;
  double pixel = 1.0;  // size of a pixel, in units of the CRS
};

inline constexpr double kNoValue = -9999.0;

// Writes a GeoTIFF of doubles that holds `value(x, y)` at each pixel's centre, with kNoValue as its nodata value.
void writeRaster(const std::string& path, const std::string& crs, const RasterShape& shape,
                 const std::function<double(double x, double y)>& value);

}  // namespace coastmesh::testing
