#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/crs/crs.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// +1 iff a, b, c turn counter-clockwise as seen from above, -1 iff clockwise, 0 iff they cannot be distinguished from a
// line. For longitudes and latitudes the sides are great circles, so that ±180, poles, full turns and triangles up to a
// hemisphere do not matter; otherwise they are straight, and the result is exact.
int orientationOnGround(const Point& a, const Point& b, const Point& c, const Crs& crs);

// Triangles of `grid` that are not counter-clockwise, ascending. In degrees on the ground: by the sign of `area_m2`,
// from `triangleAreas`, if that is given and certain, otherwise by `orientationOnGround`. In a projected CRS in its
// plane, in which programs that read the grid compute. A valid mesh has such triangles if they are far longer than high
// (sides that are straight there and on the ground differ by a hundredth of their length at about 1000 km) or if
// rounding to the CRS's coordinates flattened them.
std::vector<std::uint32_t> turnedTriangles(const Grid& grid, std::span<const double> area_m2,
                                           const ItemLoop& loop = inOrder);

// The `meanPlace` of a triangle's corners.
Point middleOf(const Grid& grid, std::uint32_t triangle);

}  // namespace coastmesh
