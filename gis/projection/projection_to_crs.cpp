#include <GeographicLib/Geodesic.hpp>
#include <cmath>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/geographic_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/projection/projection.hpp"
#include "gis/projection/projection_map.hpp"

namespace coastmesh {

namespace {

class ToCrs final : public ProjectionMap {
 public:
  ToCrs(const Crs& input, const Crs& working)
      : map_(toOgr(input), toOgr(working)),
        to_geographic_(working),
        geodesic_(working.semi_major_m, working.flattening) {
    // About 50 m.
    step_ = working.geographic ? 5e-4 : 50 / toOgr(working).GetLinearUnits();
    description = nameOf(working);
  }

  Point forward(const Point& input) const override { return map_.forward(input); }
  Point inverse(const Point& plane) const override { return map_.inverse(plane); }
  bool mayTear() const override { return true; }

  // The geometric mean of the scales along x and y, from the geodesic lengths of two short lines.
  double scaleAt(const Point& plane) const override {
    const double along_x = trueLength({plane.x - step_, plane.y}, {plane.x + step_, plane.y});
    const double along_y = trueLength({plane.x, plane.y - step_}, {plane.x, plane.y + step_});
    return 2 * step_ / std::sqrt(along_x * along_y);
  }

 private:
  double trueLength(const Point& p, const Point& q) const {
    const LonLat a = to_geographic_.forward(p), b = to_geographic_.forward(q);
    double length;
    geodesic_.Inverse(a.lat, a.lon, b.lat, b.lon, length);
    return length;
  }

  CrsMap map_;
  GeographicMap to_geographic_;
  GeographicLib::Geodesic geodesic_;
  double step_ = 0;
};

}  // namespace

Projection Projection::to(const Crs& input, const Crs& working) {
  if (working.isPlane()) return plane();
  if (input.isPlane()) {
    throw InputError("the input is in a plane without a place on Earth, so it cannot be brought to " + nameOf(working) +
                     ": give it a CRS");
  }
  return Projection(std::make_shared<ToCrs>(input, working));
}

}  // namespace coastmesh
