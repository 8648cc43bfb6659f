#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Water without a connection to an open boundary or a river, in a grid that has such boundaries: no tide reaches it.
struct ApartWater {
  std::uint32_t triangle = 0;  // its first triangle
  std::size_t triangles = 0;

  friend bool operator==(const ApartWater&, const ApartWater&) = default;
};

// In the order of their first triangles. Water is connected through edges, not through single nodes, and over weirs.
std::vector<ApartWater> apartWaters(const Grid& grid, const ItemLoop& loop = inOrder);

// A fast sufficient test: true only if all triangles are connected. REQUIRES: complete boundaries.
bool isOneWater(const Grid& grid, const ItemLoop& loop = inOrder);

// Waters with an opening that are less than a tenth as large as the largest of those: the frame only grazes them.
enum class GrazedWaters { Keep, Drop };

struct DroppedWaters {
  std::size_t waters = 0, at_open = 0;        // and those among them that have an opening
  double area_m2 = 0.0, share = 0.0;          // and its share of all water before
  std::map<std::uint32_t, double> area_of{};  // by feature, if the grid has features
  Point place;                                // in the largest water, in the grid's CRS
  bool in_plane = false;                      // areas are in units of the plane
};

// Removes apart waters from the grid, but none if those with an opening are less than a tenth of all: the main water
// may then be among them. REQUIRES: areas are known.
DroppedWaters dropApartWaters(Grid& grid, GrazedWaters grazed = GrazedWaters::Drop, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
