#pragma once

#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"
#include "gis/projection/projection.hpp"
#include "gis/rivers/river_lines.hpp"

namespace coastmesh {

// A conformal plane for rivers, in metres unless the mesh is in a plane itself.
class RiverPlane {
 public:
  // `crs`: of the mesh and of the lines; there is at least one.
  RiverPlane(const std::vector<RiverLine>& lines, const Crs& crs);

  Point forward(const Point& place) const { return projection_.forward(place); }
  // Longitudes are in the turn of the lines.
  Point inverse(const Point& plane) const;
  // Plane length over true length.
  double scaleAt(const Point& plane) const { return projection_.scaleAt(plane); }

 private:
  Projection projection_;
  bool geographic_;
  double middle_ = 0.0;  // of the lines' longitudes
};

}  // namespace coastmesh
