#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {

// What coordinates that went through a file, and a plane other than the mesh's own, may cost: an angle counts as short,
// and an edge as not Delaunay, only by more than this.
inline constexpr double kAngleSlackDeg = 0.01;

// Nodes that lie near one another in a plane of their own: metres in the tangent plane of the sphere at their middle
// for longitudes and latitudes, so that poles and the turn of longitudes do not matter; the coordinates as they are
// otherwise. Angles and lengths are right to the square of their extent over the Earth's radius.
std::vector<Point> localPlane(const Grid& grid, std::span<const std::uint32_t> nodes);
std::vector<Point> localPlane(const Crs& crs, std::span<const Point> places);
void flattenLocally(const Crs& crs, std::span<Point> places);  // the same, in their place
// The same of longitudes and latitudes that are known as places on the sphere, for who asks again and again.
void flattenLocally(const Crs& crs, std::span<const SphereVector> on_sphere, std::span<Point> places);

}  // namespace coastmesh
