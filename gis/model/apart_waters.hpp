#pragma once

#include <cstdint>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Water that nothing joins to an open boundary or a river, in a grid that has some: no tide comes there.
struct ApartWater {
  std::uint32_t triangle = 0;  // its first
  std::size_t triangles = 0;
};

// In the order of their first triangles. Water hangs together by edges: through a node nothing flows.
std::vector<ApartWater> apartWaters(const Grid& grid);

}  // namespace coastmesh
