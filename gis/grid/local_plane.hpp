#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {

// A tolerance for coordinates that went through a file, or a plane other than the mesh's own: an angle counts as too
// small, and an edge as not Delaunay, only by more than this.
inline constexpr double kAngleSlackDeg = 0.01;

// Nodes that are close together, in a plane of their own: for longitudes and latitudes, metres in a plane that touches
// the Earth at their mean, so that poles and the jump of longitudes do not matter; otherwise their own coordinates.
// Relative errors of angles and lengths on that shape of the Earth are about the square of their extent over its
// radius, and 6e-6.
std::vector<Point> localPlane(const Crs& crs, std::span<const Point> places, EarthShape shape = EarthShape::Ellipsoid);
// The same, in place.
void flattenLocally(const Crs& crs, std::span<Point> places, EarthShape shape = EarthShape::Ellipsoid);
// The same for nodes of a grid.
template <std::size_t count>
std::array<Point, count> localPlane(const Grid& grid, const std::array<std::uint32_t, count>& nodes,
                                    EarthShape shape = EarthShape::Ellipsoid) {
  std::array<Point, count> places;
  for (std::size_t i = 0; i < count; ++i) places[i] = grid.nodes[nodes[i]];
  flattenLocally(grid.crs, places, shape);
  return places;
}
// The same for longitudes and latitudes converted by `inSpace` beforehand, for repeated calls.
void flattenLocally(const Crs& crs, std::span<const SphereVector> in_space, std::span<Point> places);

}  // namespace coastmesh
