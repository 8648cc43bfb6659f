#pragma once

#include <ogr_spatialref.h>

#include <memory>
#include <span>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// PROJ's transformation between two CRS, usable from several threads at once: PROJ's objects are not, so each thread
// creates its own. Cheap to copy.
class CrsMap {
 public:
  // Throws InputError if PROJ has no transformation.
  CrsMap(const OGRSpatialReference& from, const OGRSpatialReference& to);

  Point forward(const Point& p) const;                           // not finite if `p` has no image
  void forward(std::span<double> x, std::span<double> y) const;  // the same for many points, in place
  Point inverse(const Point& p) const;                           // of `forward`, up to rounding

  struct Ends;

 private:
  std::shared_ptr<const Ends> ends_;
};

// From a projected CRS to its longitudes and latitudes. PROJ takes milliseconds to make a transformation, so each
// thread keeps the last four. REQUIRES: neither a plane nor geographic. Throws InputError if PROJ has none.
std::shared_ptr<const CrsMap> mapToGeographic(const Crs& crs);

// The geographic CRS of a projected one. REQUIRES: !crs.isPlane(). Throws InputError if there is none.
OGRSpatialReference geographicBase(const Crs& crs);

}  // namespace coastmesh
