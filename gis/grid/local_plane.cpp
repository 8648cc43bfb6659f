#include "gis/grid/local_plane.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "gis/crs/lon_lat.hpp"

namespace coastmesh {
namespace {

using Vector = std::array<double, 3>;

Vector unitVector(const LonLat& place) {
  constexpr double kRadian = std::numbers::pi / 180.0;
  const double cosine = std::cos(place.lat * kRadian);
  return {cosine * std::cos(place.lon * kRadian), cosine * std::sin(place.lon * kRadian),
          std::sin(place.lat * kRadian)};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector scaled(const Vector& a, double by) { return {a[0] * by, a[1] * by, a[2] * by}; }

}  // namespace

void flattenLocally(const Crs& crs, std::span<Point> places) {
  if (!crs.geographic || places.empty()) return;
  Vector middle{};
  for (const Point& place : places) {
    const Vector on_sphere = unitVector(asLonLat(place));
    for (std::size_t k = 0; k < 3; ++k) middle[k] += on_sphere[k];
  }
  middle = scaled(middle, 1.0 / std::sqrt(dot(middle, middle)));
  // East of the middle is nowhere at a pole; any direction will do there.
  Vector east = cross({0.0, 0.0, 1.0}, middle);
  if (dot(east, east) < 1e-12) east = {1.0, 0.0, 0.0};
  east = scaled(east, 1.0 / std::sqrt(dot(east, east)));
  const Vector north = cross(middle, east);
  for (Point& place : places) {
    const Vector on_sphere = unitVector(asLonLat(place));
    place = {crs.semi_major_m * dot(on_sphere, east), crs.semi_major_m * dot(on_sphere, north)};
  }
}

std::vector<Point> localPlane(const Crs& crs, std::span<const Point> places) {
  std::vector<Point> plane(places.begin(), places.end());
  flattenLocally(crs, plane);
  return plane;
}

std::vector<Point> localPlane(const Grid& grid, std::span<const std::uint32_t> nodes) {
  std::vector<Point> places;
  for (const std::uint32_t node : nodes) places.push_back(grid.nodes[node]);
  return localPlane(grid.crs, places);
}

}  // namespace coastmesh
