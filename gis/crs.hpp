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

// `text` is "plane" or anything that PROJ knows: "EPSG:32616", WKT, a PROJ string. Vertical axes are dropped; a local
// (engineering) CRS is a plane. Throws InputError, also for geocentric CRS and for geographic ones that do not measure
// in degrees.
Crs parseCrs(const std::string& text);

Crs wgs84();

// True iff coordinates mean the same place in both.
bool sameCrs(const Crs& a, const Crs& b);

// Metres on the ground that a unit of the coordinates stands for, at a scale of 1; of degrees those at the equator; 1 for a
// plane.
double metresPerUnit(const Crs& crs);

// For people: "EPSG:32616", else the name that the CRS gives itself, else "plane".
std::string nameOf(const Crs& crs);

}  // namespace coastmesh
