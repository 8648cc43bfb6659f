#include "gis/grid/on_sphere.hpp"

#include <GeographicLib/Math.hpp>
#include <cmath>

namespace coastmesh {

using GeographicLib::Math;

SphereVector onSphere(const LonLat& place) {
  double sin_lon, cos_lon, sin_lat, cos_lat;
  Math::sincosd(place.lon, sin_lon, cos_lon);
  Math::sincosd(place.lat, sin_lat, cos_lat);
  return {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};
}

SphereVector inSpace(const LonLat& place, const Crs& crs, EarthShape shape) {
  const SphereVector normal = onSphere(place);
  if (shape == EarthShape::Sphere) return normal;
  const double e2 = crs.flattening * (2.0 - crs.flattening);
  const double n = 1.0 / std::sqrt(1.0 - e2 * normal[2] * normal[2]);
  return {n * normal[0], n * normal[1], n * (1.0 - e2) * normal[2]};
}

SphereVector fromEllipsoid(const SphereVector& place, const Crs& crs) {
  const double e2 = crs.flattening * (2.0 - crs.flattening);
  return unit({place[0], place[1], place[2] / (1.0 - e2)});
}

LonLat placeOf(const SphereVector& v) {
  const double to_axis = std::hypot(v[0], v[1]);
  return {to_axis == 0.0 ? 0.0 : Math::atan2d(v[1], v[0]), Math::atan2d(v[2], to_axis)};
}

double dot(const SphereVector& a, const SphereVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

SphereVector cross(const SphereVector& a, const SphereVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

SphereVector scaled(const SphereVector& a, double by) { return {a[0] * by, a[1] * by, a[2] * by}; }

SphereVector minus(const SphereVector& a, const SphereVector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

SphereVector unit(const SphereVector& a) { return scaled(a, 1.0 / std::sqrt(dot(a, a))); }

std::array<double, 3> flatAnglesDeg(const SphereVector& a, const SphereVector& b, const SphereVector& c) {
  const auto angleAt = [](const SphereVector& apex, const SphereVector& p, const SphereVector& q) {
    const SphereVector to_p = minus(p, apex), to_q = minus(q, apex), across = cross(to_p, to_q);
    return Math::atan2d(std::sqrt(dot(across, across)), dot(to_p, to_q));
  };
  return {angleAt(a, b, c), angleAt(b, c, a), angleAt(c, a, b)};
}

SphereVector circumcentreOnSphere(const SphereVector& a, const SphereVector& b, const SphereVector& c) {
  return unit(cross(minus(b, a), minus(c, a)));
}

}  // namespace coastmesh
