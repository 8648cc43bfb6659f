#pragma once

#include <cstddef>

#include "core/item_loop.hpp"
#include "gis/flood_plain/plain_land.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Edges of open boundaries that became land.
struct DrySides {
  std::size_t edges = 0;
  double length_m = 0.0;
  Point place;  // the middle of the first
};

// Parts of open boundaries that cross land become land: edges of triangles on the land of a flood plain, and others at
// nodes that are not below the water, or on that land. One or two such nodes between others stay open, as at a sand
// bar: models need water there, and a repair lowers them. So does one at the end of an open boundary, where it meets
// the coast, unless `to_the_coast`. Nodes without a depth count as water. REQUIRES: no boundary is a weir.
DrySides closeDrySides(Grid& grid, bool to_the_coast, const LandFlags& land = {}, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
