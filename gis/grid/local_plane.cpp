#include "gis/grid/local_plane.hpp"

#include <array>

#include "gis/crs/lon_lat.hpp"

namespace coastmesh {

void flattenLocally(const Crs& crs, std::span<Point> places) {
  if (!crs.geographic || places.empty()) return;
  std::array<SphereVector, 4> few;
  std::vector<SphereVector> many;
  if (places.size() > few.size()) many.resize(places.size());
  const std::span<SphereVector> on_sphere = many.empty() ? std::span(few).first(places.size()) : std::span(many);
  for (std::size_t i = 0; i < places.size(); ++i) on_sphere[i] = onSphere(asLonLat(places[i]));
  flattenLocally(crs, on_sphere, places);
}

void flattenLocally(const Crs& crs, std::span<const SphereVector> on_sphere, std::span<Point> places) {
  SphereVector middle{};
  for (const SphereVector& place : on_sphere)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += place[k];
  middle = unit(middle);
  // At a pole east is undefined; any direction will do.
  SphereVector east = cross({0.0, 0.0, 1.0}, middle);
  if (dot(east, east) < 1e-12) east = {1.0, 0.0, 0.0};
  east = unit(east);
  const SphereVector north = cross(middle, east);
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = {crs.semi_major_m * dot(on_sphere[i], east), crs.semi_major_m * dot(on_sphere[i], north)};
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
