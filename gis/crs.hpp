#pragma once

#include <string>

namespace coastmesh {

// A coordinate reference system as text. Coordinates are always x = easting or longitude, y = northing or latitude.
struct Crs {
  std::string wkt;          // WKT 2, or empty: a plane without a place on Earth
  std::string authority;    // "EPSG:4326" where known, else empty
  bool geographic = false;  // degrees of longitude and latitude

  bool isPlane() const { return wkt.empty(); }
};

// `text` is "plane" or anything that PROJ knows: "EPSG:32616", WKT, a PROJ string. Throws InputError.
Crs parseCrs(const std::string& text);

Crs wgs84();

}  // namespace coastmesh
