#pragma once

#include <memory>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"
#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

class CrsMap;

// Converts coordinates of a CRS to longitudes and latitudes on its ellipsoid, and back; the identity for a geographic
// CRS. Cheap to copy; usable from several threads at once.
class GeographicMap {
 public:
  // REQUIRES: !crs.isPlane(). Throws InputError if PROJ has no transformation.
  explicit GeographicMap(const Crs& crs);

  LonLat forward(const Point& input) const;  // not finite if `input` has no image
  Point inverse(const LonLat& place) const;
  bool isIdentity() const { return !map_; }

 private:
  std::shared_ptr<const CrsMap> map_;
};

}  // namespace coastmesh
