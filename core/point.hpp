#pragma once

namespace coastmesh {

// A point in a plane: the meshed plane, or that of a CRS, whose x is the easting or longitude, as in files. Longitude
// and latitude on an ellipsoid are a LonLat: see gis/crs/lon_lat.hpp.
struct Point {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
};

// The order used to break ties: by x, then y.
inline bool lexLess(const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

}  // namespace coastmesh
