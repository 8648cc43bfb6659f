#include "gis/crs/edge_area.hpp"

#include <cmath>
#include <numbers>

namespace coastmesh {

namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Larger edges, and ellipsoids of larger eccentricity, are left to Karney's formulas.
constexpr double kLargestStep = 0.2;            // degrees, of latitude
constexpr double kLargestTurn = 0.5;            // degrees, of longitude
constexpr double kLargestEccentricity2 = 0.01;  // squared

}  // namespace

EdgeArea::EdgeArea(double semi_major_m, double flattening)
    : geodesic_(semi_major_m, flattening), a_(semi_major_m), e2_(flattening * (2 - flattening)) {}

EdgeArea::Vertex EdgeArea::at(const LonLat& place) const {
  const double s = std::sin(place.lat * kDegree), x = e2_ * s * s;
  // b^2 / 2 (s / (1 - x) + atanh(e s) / e), Snyder (1987), equation 3-12; the series of atanh is truncated below 1e-16.
  const double series = 1 + x * (1.0 / 3 + x * (1.0 / 5 + x * (1.0 / 7 + x * (1.0 / 9 + x * (1.0 / 11 + x / 13)))));
  return {place.lon, place.lat, s, a_ * a_ * (1 - e2_) / 2 * s * (1 / (1 - x) + series)};
}

// On the map with x = longitude and y = `per_radian`, areas are true. A geodesic y(x) there has y'' = -sin(lat) (r^2 +
// 3 M^2 lat'^2) by Clairaut's relation, with r the radius of the parallel and M that of the meridian. A short one thus
// deviates from its chord by a parabola and encloses -y'' dx^3 / 12 with it.
double EdgeArea::under(const Vertex& from, const Vertex& to) const {
  const double turn = to.lon_deg - from.lon_deg, step = to.lat_deg - from.lat_deg;
  if (std::abs(turn) > kLargestTurn || std::abs(step) > kLargestStep || std::abs(e2_) > kLargestEccentricity2) {
    double area = 0, unused = 0;
    geodesic_.GenInverse(from.lat_deg, from.lon_deg, to.lat_deg, to.lon_deg, GeographicLib::Geodesic::AREA, unused,
                         unused, unused, unused, unused, unused, area);
    return area;
  }
  const double dx = turn * kDegree, dlat = step * kDegree;
  const double s = (from.sin_lat + to.sin_lat) / 2, w = 1 - e2_ * s * s;
  const double parallel2 = a_ * a_ * (1 - s * s) / w;
  const double meridian2 = a_ * a_ * (1 - e2_) * (1 - e2_) / (w * w * w);
  return dx * ((from.per_radian + to.per_radian) / 2 + s * (parallel2 * dx * dx + 3 * meridian2 * dlat * dlat) / 12);
}

}  // namespace coastmesh
