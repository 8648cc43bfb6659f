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

// Where a merge has cut a weir of the grid: water flows past its end.
struct WeirGap {
  double length_m = 0.0;  // to the next end of a weir of the inserted mesh, or of what is lost; plane units in a plane
  Point place;            // of the end, in the grid's CRS
};

struct CutWeirs {
  std::vector<WeirGap> gaps;  // the longest first
  double lost_m = 0.0;        // of weirs of the grid for which the inserted mesh, which has none, leaves no place
  Point lost_at;
};

// `merged`: has all nodes that either mesh had. `before`, `inserted`: the weirs of both, in its numbers.
CutWeirs cutWeirs(const Grid& merged, std::span<const WeirPairs> before, std::span<const WeirPairs> inserted);

}  // namespace coastmesh
