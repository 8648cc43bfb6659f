#pragma once

#include "core/surface.hpp"
#include "gis/geometry/box.hpp"
#include "gis/projection/plane_table.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// `Projection::scaleAt` and `Projection::measureAt` to within 1e-5 (the scale of a sphere's plane: to 1e-5 of itself),
// from a table of the latter, which varies little. Usable from several threads.
class ScaleTable {
 public:
  // Fast within the box; outside it the projection is evaluated.
  ScaleTable(const Projection& projection, const Box& box)
      : surface_(projection.surface()),
        table_(
            [projection](const Point& x) {
              return Point{projection.measureAt(x), 0.0};
            },
            box, kTolerance) {}

  double at(const Point& x) const { return measureAt(x) / surface_.shrinkAt(x); }
  double measureAt(const Point& x) const { return table_.at(x).x; }
  const Surface& surface() const { return surface_; }  // represented by the plane

 private:
  static constexpr double kTolerance = 1e-5;

  Surface surface_;
  PlaneTable table_;
};

}  // namespace coastmesh
