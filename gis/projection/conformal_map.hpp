#pragma once

#include <memory>
#include <optional>
#include <stdexcept>

#include "core/point.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"
#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

// An ellipsoid of revolution: semi-major axis in metres, flattening.
struct Ellipsoid {
  double a = 6378137.0;
  double f = 1.0 / 298.257223563;
};

// A conformal map of the ellipsoid onto a plane in metres. Thread-safe. `inverse` returns longitudes in [-180, 180];
// `forward` returns NaN for a latitude beyond the poles.
class ConformalMap {
 public:
  virtual ~ConformalMap() = default;
  virtual Point forward(const LonLat& place) const = 0;
  virtual LonLat inverse(const Point& plane) const = 0;
  virtual double scaleAt(const Point& plane) const = 0;  // plane length over length on the ellipsoid
  // The sphere that it maps stereographically; flat if there is none.
  virtual Surface sphere() const { return {}; }
  // `inverse`, `scaleAt` and the point in space, in metres from the centre of the ellipsoid, in one call that costs
  // little more than the first; the latter two to a few units in the last place. REQUIRES: sphere().isCurved()
  struct OnGround {
    LonLat place;
    SpacePoint space;
    double scale = 1.0;
  };
  virtual OnGround onGround(const Point&) const { throw std::logic_error("a map of no sphere"); }
  // The place that maps to infinity, to a thousandth of a degree, if the map shows all others.
  virtual std::optional<LonLat> infinity() const { return std::nullopt; }
};

// Each has its origin, and scale 1, at the given centre or pole; the conic has scale 1 on its two parallels.
std::unique_ptr<ConformalMap> transverseMercator(const Ellipsoid& ellipsoid, const LonLat& centre);
std::unique_ptr<ConformalMap> lambertConic(const Ellipsoid& ellipsoid, const LonLat& centre, double parallel1,
                                           double parallel2);
std::unique_ptr<ConformalMap> polarStereographic(const Ellipsoid& ellipsoid, bool north, double central_meridian);
std::unique_ptr<ConformalMap> obliqueStereographic(const Ellipsoid& ellipsoid, const LonLat& centre);

}  // namespace coastmesh
