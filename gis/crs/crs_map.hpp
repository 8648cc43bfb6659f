#pragma once

#include <ogr_spatialref.h>

#include <memory>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// PROJ's transformation between two CRS, usable from several threads at once: PROJ's objects are not, so each thread
// creates its own. Cheap to copy.
class CrsMap {
 public:
  // Throws InputError if PROJ has no transformation.
  CrsMap(const OGRSpatialReference& from, const OGRSpatialReference& to);

  Point forward(const Point& p) const;  // not finite if `p` has no image
  Point inverse(const Point& p) const;  // of `forward`, up to rounding

  struct Ends;

 private:
  std::shared_ptr<const Ends> ends_;
};

// The geographic CRS of a projected one. REQUIRES: !crs.isPlane(). Throws InputError if there is none.
OGRSpatialReference geographicBase(const Crs& crs);

}  // namespace coastmesh
