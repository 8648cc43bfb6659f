#pragma once

#include <ogr_spatialref.h>

#include <memory>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// PROJ's transformation from one CRS to another, usable from several threads at once: PROJ's own objects are not, so
// each thread makes its own. Cheap to copy.
class CrsMap {
 public:
  // Throws InputError where PROJ knows no way.
  CrsMap(const OGRSpatialReference& from, const OGRSpatialReference& to);

  Point forward(const Point& p) const;  // not finite where `p` has no image
  Point inverse(const Point& p) const;  // of `forward`, to rounding

  struct Ends;

 private:
  std::shared_ptr<const Ends> ends_;
};

// The geographic CRS under a projected one. REQUIRES: !crs.isPlane(). Throws InputError where there is none.
OGRSpatialReference geographicBase(const Crs& crs);

}  // namespace coastmesh
