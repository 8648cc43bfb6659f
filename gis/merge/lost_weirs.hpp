#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/point.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The pairs of nodes of a weir, one after the other.
using WeirPairs = std::vector<NodePair>;

// The weirs of a grid over which water flows between pairs of nodes.
std::vector<WeirPairs> weirsOf(const Grid& grid);

// Where a merge has taken a part of a weir of the grid, and no weir of the inserted mesh is in its place, so that water
// flows past it.
struct WeirGap {
  double length_m = 0.0;  // plane units in a plane
  Point place;            // of the end of what is left of the weir, else in the middle; in the grid's CRS
};

// The longest first. `merged`: has all nodes that either mesh had. `before`, `inserted`: the weirs of both, in its
// numbers.
std::vector<WeirGap> weirGaps(const Grid& merged, std::span<const WeirPairs> before,
                              std::span<const WeirPairs> inserted);

}  // namespace coastmesh
