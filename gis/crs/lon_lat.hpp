#pragma once

#include "core/point.hpp"

namespace coastmesh {

// A place on an ellipsoid, in degrees. What a file or the user gives is a Point in the coordinates of a CRS, which may
// be anything: GeographicMap makes one of the other.
struct LonLat {
  double lon = 0.0;
  double lat = 0.0;

  friend bool operator==(const LonLat&, const LonLat&) = default;
};

// Coordinates of a geographic CRS, whose x are longitudes, and the way back.
inline LonLat asLonLat(const Point& geographic) { return {geographic.x, geographic.y}; }
inline Point asGeographic(const LonLat& place) { return {place.lon, place.lat}; }

}  // namespace coastmesh
