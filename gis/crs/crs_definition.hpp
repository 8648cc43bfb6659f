#pragma once

#include <string>

namespace coastmesh {

// A coordinate reference system as text. Coordinates are always x = easting or longitude, y = northing or latitude.
struct Crs {
  std::string wkt;          // WKT 2, or empty: a plane without a place on Earth
  std::string authority;    // "EPSG:4326" where known, else empty
  bool geographic = false;  // degrees of longitude and latitude
  // The ellipsoid: semi-major axis in metres, flattening.
  double semi_major_m = 6378137.0;
  double flattening = 1.0 / 298.257223563;

  bool isPlane() const { return wkt.empty(); }
};

}  // namespace coastmesh
