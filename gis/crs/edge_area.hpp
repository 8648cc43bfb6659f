#pragma once

#include <GeographicLib/Geodesic.hpp>

#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

// Areas between geodesics and the equator, in square metres; positive for edges that go east, north of the equator. A
// million short edges take 0.05 s; GeographicLib's PolygonArea takes 2 s, more than reading them.
class EdgeArea {
 public:
  EdgeArea(double semi_major_m, double flattening);

  // The contribution of a vertex to its two edges.
  struct Vertex {
    double lon_deg = 0, lat_deg = 0;
    double sin_lat = 0;
    double per_radian = 0;  // area between its parallel and the equator, per radian of longitude
  };
  Vertex at(const LonLat& place) const;

  // REQUIRES: the longitudes are less than 180 degrees apart as given, with no pole between or among them. Accurate to
  // about 1e-9 of the area that edges of this length can enclose.
  double under(const Vertex& from, const Vertex& to) const;

  const GeographicLib::Geodesic& geodesic() const { return geodesic_; }

 private:
  GeographicLib::Geodesic geodesic_;
  double a_, e2_;
};

}  // namespace coastmesh
