#pragma once

#include <cstdint>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Water without a connection to an open boundary or a river, in a grid that has some: no tide reaches it.
struct ApartWater {
  std::uint32_t triangle = 0;  // the first of them
  std::size_t triangles = 0;
};

// In the order of their first triangles. Water is connected through edges, not through single nodes.
std::vector<ApartWater> apartWaters(const Grid& grid);

}  // namespace coastmesh
