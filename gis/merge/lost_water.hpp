#pragma once

#include <cstdint>
#include <span>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/nest_plane.hpp"

namespace coastmesh {

// Water that a mesh has no more.
struct LostWater {
  double area_m2 = 0.0;     // plane units in a plane
  double largest_m2 = 0.0;  // of the triangle that has lost most
  Point place;              // in the middle of that
};

// What of the triangles of `before` is in none of these triangles of `now`. Both are in the same CRS, none overlaps
// another of its mesh.
// `plane`: where they are compared; null: in their own coordinates.
LostWater lostWater(const Grid& before, const Grid& now, std::span<const std::uint32_t> triangles,
                    const NestPlane* plane = nullptr, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
