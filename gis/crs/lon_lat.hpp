#pragma once

#include "core/point.hpp"

namespace coastmesh {

// A point on an ellipsoid, in degrees. Files and users give a Point in coordinates of any CRS; GeographicMap converts
// between the two.
struct LonLat {
  double lon = 0.0;
  double lat = 0.0;

  friend bool operator==(const LonLat&, const LonLat&) = default;
};

// Coordinates of a geographic CRS, with longitudes as x, and back.
inline LonLat asLonLat(const Point& geographic) { return {geographic.x, geographic.y}; }
inline Point asGeographic(const LonLat& place) { return {place.lon, place.lat}; }

}  // namespace coastmesh
