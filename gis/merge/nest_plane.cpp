#include "gis/merge/nest_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/sphere/sphere_place.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/one_turn.hpp"

namespace coastmesh {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
// From the middle of the inserted mesh: how far it may reach, and from where on places are on the other side.
constexpr double kMostReachDeg = 80.0, kFarDeg = 120.0;

bool isPole(const Point& place) { return std::abs(place.y) == 90.0; }

bool jumps(const Grid& grid, const ItemLoop& loop) {
  const std::vector<std::uint8_t> found =
      overStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t)
          if (longitudesJump(grid.nodes, grid.triangles[t]) ||
              std::ranges::any_of(grid.triangles[t], [&](std::uint32_t node) { return isPole(grid.nodes[node]); }))
            return std::uint8_t{1};
        return std::uint8_t{0};
      });
  return std::ranges::find(found, 1) != found.end();
}

SphereVector middleOf(const Grid& grid) {
  SphereVector sum{};
  for (const Point& node : grid.nodes) {
    const SphereVector place = onSphere(asLonLat(node));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += place[k];
  }
  if (!(dot(sum, sum) > 0.0)) sum = {0.0, 0.0, 1.0};
  return unit(sum);
}

}  // namespace

NestPlane::NestPlane(const SphereVector& middle, double radius_m)
    : middle_(middle), surface_(Surface::sphere(radius_m)) {
  // Any direction that is not that of the middle.
  const SphereVector up = std::abs(middle[2]) < 0.9 ? SphereVector{0.0, 0.0, 1.0} : SphereVector{1.0, 0.0, 0.0};
  east_ = unit(cross(up, middle_));
  north_ = cross(middle_, east_);
}

std::optional<NestPlane> NestPlane::around(const Grid& grid, const Grid& inserted, const ItemLoop& loop) {
  if (!grid.crs.geographic || inserted.nodes.empty() || (!jumps(grid, loop) && !jumps(inserted, loop)))
    return std::nullopt;
  const SphereVector middle = middleOf(inserted);
  const double least = std::cos(kMostReachDeg / kDegrees);
  for (const Point& node : inserted.nodes)
    if (dot(onSphere(asLonLat(node)), middle) < least)
      throw InputError("the mesh that is put in reaches more than " + std::to_string(static_cast<int>(kMostReachDeg)) +
                       " degrees of arc from its middle, too far for one plane");
  return NestPlane(middle, grid.crs.semi_major_m);
}

Point NestPlane::forward(const Point& lon_lat) const {
  const SphereVector place = onSphere(asLonLat(lon_lat));
  const Point plane = planeOf({dot(place, east_), dot(place, north_), dot(place, middle_)}, surface_);
  // The opposite place itself is at infinity, in no direction.
  constexpr double kFarthest = 1e6;  // radii
  if (std::hypot(plane.x, plane.y) <= kFarthest * surface_.radius()) return plane;
  return {kFarthest * surface_.radius(), 0.0};
}

Point NestPlane::inverse(const Point& plane) const {
  const auto [east, north, up] = placeOnSphere(plane, surface_);
  SphereVector place;
  for (std::size_t k = 0; k < 3; ++k) place[k] = east * east_[k] + north * north_[k] + up * middle_[k];
  const LonLat at = placeOf(place);
  return {at.lon, at.lat};
}

Grid NestPlane::flat(const Grid& grid, const ItemLoop& loop) const {
  Grid flat = grid;
  flat.crs = {};
  forEachByStretches(loop, flat.nodes.size(), [&](std::size_t v) { flat.nodes[v] = forward(grid.nodes[v]); });
  return flat;
}

bool NestPlane::isFar(const Point& plane) const {
  static const double kFar = 2.0 * std::tan(0.5 * kFarDeg / kDegrees);  // radii
  return std::hypot(plane.x, plane.y) > kFar * surface_.radius();
}

void matchTurn(Grid& inserted, const Grid& grid) {
  constexpr double kTurn = 360.0;
  const Box box = boxAround(grid.nodes, inOrder);
  // Usual ranges, so that longitudes between those of the grid's nodes are within them too.
  const double west = box.xmin >= -180.0 && box.xmax <= 180.0 ? -180.0
                      : box.xmin >= 0.0 && box.xmax <= 360.0  ? 0.0
                                                              : box.xmin;
  for (Point& node : inserted.nodes)
    if (node.x < west || node.x > west + kTurn) node.x -= kTurn * std::floor((node.x - west) / kTurn);
}

}  // namespace coastmesh
