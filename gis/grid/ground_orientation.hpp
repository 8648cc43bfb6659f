#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/crs/crs.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// +1 iff a, b, c turn counter-clockwise as seen from above, -1 iff clockwise, 0 iff they cannot be told from a line.
// For longitudes and latitudes the sides are great circles, so that ±180, poles, whole revolutions and triangles up to
// a hemisphere do not matter; elsewhere they are straight, and the answer is exact.
int orientationOnGround(const Point& a, const Point& b, const Point& c, const Crs& crs);

// Triangles of `grid` that are not counter-clockwise, ascending: in degrees on the ground, where the sign of `area_m2`,
// as `triangleAreas` gives it, counts if it leaves no doubt, else `orientationOnGround`; in a projected CRS in its
// plane, which is what programs that read the grid compute in. A mesh that is right in its working plane has
// such triangles where they are far longer than high (sides that are straight there and on the ground differ by a
// hundredth of their length for some 1000 km) or where rounding to the CRS's coordinates flattened them.
std::vector<std::uint32_t> turnedTriangles(const Grid& grid, std::span<const double> area_m2,
                                           const ItemLoop& loop = inOrder);

// The `meanPlace` of a triangle's corners.
Point middleOf(const Grid& grid, std::uint32_t triangle);

}  // namespace coastmesh
