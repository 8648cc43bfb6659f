#pragma once

#include "gis/geometry/box.hpp"
#include "gis/projection/plane_table.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// `Projection::scaleAt` to within 1e-5, from a table. Usable from several threads.
class ScaleTable {
 public:
  // Fast within the box; beyond it the projection is asked.
  ScaleTable(const Projection& projection, const Box& box)
      : table_(
            [projection](const Point& x) {
              return Point{projection.scaleAt(x), 0.0};
            },
            box, kTolerance) {}

  double at(const Point& x) const { return table_.at(x).x; }

 private:
  static constexpr double kTolerance = 1e-5;

  PlaneTable table_;
};

}  // namespace coastmesh
