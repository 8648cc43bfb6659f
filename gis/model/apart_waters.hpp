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

// True only where all triangles are connected: found for most grids at a share of the cost of what follows. REQUIRES:
// boundaries that are complete.
bool isOneWater(const Grid& grid);

struct DroppedWaters {
  std::size_t waters = 0;
  double area_m2 = 0.0, share = 0.0;  // and of all water that there was
  Point place;                        // in the largest, in the grid's CRS
  bool in_plane = false;              // areas are in units of the plane
};

// Takes these waters out of the grid, but none if the others are less than a tenth of all: the largest may then be
// among them. REQUIRES: areas are known.
DroppedWaters dropApartWaters(Grid& grid);

}  // namespace coastmesh
