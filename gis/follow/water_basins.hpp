#pragma once

#include <cstdint>
#include <vector>

#include "core/union_find.hpp"
#include "gis/follow/shore_balance.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/water_gaps.hpp"

namespace coastmesh {

// For each triangle of the data, also of land that was removed: the index of the opened water that it is in; kNone on
// land and in water that was closed. REQUIRES: `opened.after` is not settled.
std::vector<std::uint32_t> watersIn(const ShoreTriangles& data, const OpenedShores& opened);

// Sets of triangles of the data: water that stays open, and is connected by nothing narrow in the data.
struct WaterBasins {
  std::vector<std::uint32_t> water;  // `watersIn`
  UnionFind sets;
  std::vector<char> is_large;  // by first triangle of a set: many elements
};

// REQUIRES: `opened.after` is not settled.
WaterBasins basinsOf(const WaterGaps& gaps, const OpenedShores& opened);

// Lines through land that was removed and that, with narrow water beside it, separates large basins of one water in the
// data: whether these are connected is to be decided by the width of that water, not by that of the land.
std::vector<ShoreLine> separatingLand(const WaterGaps& gaps, WaterBasins&& basins);

}  // namespace coastmesh
