#include "gis/grid/local_plane.hpp"

#include "gis/crs/lon_lat.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {
void flattenLocally(const Crs& crs, std::span<Point> places) {
  if (!crs.geographic || places.empty()) return;
  SphereVector middle{};
  for (const Point& place : places) {
    const SphereVector on_sphere = onSphere(asLonLat(place));
    for (std::size_t k = 0; k < 3; ++k) middle[k] += on_sphere[k];
  }
  middle = unit(middle);
  // East of the middle is nowhere at a pole; any direction will do there.
  SphereVector east = cross({0.0, 0.0, 1.0}, middle);
  if (dot(east, east) < 1e-12) east = {1.0, 0.0, 0.0};
  east = unit(east);
  const SphereVector north = cross(middle, east);
  for (Point& place : places) {
    const SphereVector on_sphere = onSphere(asLonLat(place));
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
