#include "gis/crs/handedness.hpp"

#include <GeographicLib/Math.hpp>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "gis/crs/geographic_map.hpp"

namespace coastmesh {

namespace {

using Vector = std::array<double, 3>;

Vector onUnitSphere(const LonLat& place) {
  double sin_lon, cos_lon, sin_lat, cos_lat;
  GeographicLib::Math::sincosd(place.lon, sin_lon, cos_lon);
  GeographicLib::Math::sincosd(place.lat, sin_lat, cos_lat);
  return {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};
}

double determinant(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// EPSG codes of projections with axes south and west, and of the same projections with axes east and north.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kUnmirrored{{
    {"EPSG:2065", "EPSG:5221"},
    {"EPSG:5224", "EPSG:5225"},
    {"EPSG:5513", "EPSG:5514"},
    {"EPSG:5515", "EPSG:5516"},
    {"EPSG:8352", "EPSG:8353"},
}};

}  // namespace

bool mirrorsGround(const Crs& crs, const Point& place) {
  if (crs.isPlane() || crs.geographic) return false;
  constexpr double kStep = 1000.0;  // metres: small against curvature, large against rounding
  const double step = kStep / metresPerUnit(crs);
  const GeographicMap map(crs);
  const auto at = [&](double x, double y) { return onUnitSphere(map.forward({place.x + x, place.y + y})); };
  return determinant(at(0.0, 0.0), at(step, 0.0), at(0.0, step)) < 0.0;
}

std::string unmirrored(const Crs& crs) {
  const std::string axes = "axes east and north";
  for (const auto& [mirrored, other] : kUnmirrored)
    if (crs.authority == mirrored) return std::string(other) + ", which has " + axes;
  return "a CRS with " + axes;
}

}  // namespace coastmesh
