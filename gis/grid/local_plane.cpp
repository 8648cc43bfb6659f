#include "gis/grid/local_plane.hpp"

#include <array>

#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

void flattenLocally(const Crs& crs, std::span<Point> places, EarthShape shape) {
  if (!crs.geographic || places.empty()) return;
  std::array<SphereVector, 4> few;
  std::vector<SphereVector> many;
  if (places.size() > few.size()) many.resize(places.size());
  const std::span<SphereVector> in_space = many.empty() ? std::span(few).first(places.size()) : std::span(many);
  for (std::size_t i = 0; i < places.size(); ++i) in_space[i] = inSpace(asLonLat(places[i]), crs, shape);
  flattenLocally(crs, in_space, places);
}

void flattenLocally(const Crs& crs, std::span<const SphereVector> in_space, std::span<Point> places) {
  SphereVector middle{};
  for (const SphereVector& place : in_space)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += place[k];
  middle = unit(middle);
  // At a pole east is undefined; any direction will do.
  SphereVector east = cross({0.0, 0.0, 1.0}, middle);
  if (dot(east, east) < 1e-12) east = {1.0, 0.0, 0.0};
  east = unit(east);
  const SphereVector north = cross(middle, east);
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = {crs.semi_major_m * dot(in_space[i], east), crs.semi_major_m * dot(in_space[i], north)};
}

std::vector<Point> localPlane(const Crs& crs, std::span<const Point> places, EarthShape shape) {
  std::vector<Point> plane(places.begin(), places.end());
  flattenLocally(crs, plane, shape);
  return plane;
}

}  // namespace coastmesh
