#pragma once

#include <cstddef>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/rules/edge_search.hpp"
#include "gis/rules/rule_chains.hpp"

namespace coastmesh {

inline constexpr double kWall =
    3.0;  // elements: a line that goes no farther away, and comes back, is about the boundary

// A place on a line.
struct Sample {
  Point place;
  double length = 0.0;   // of the line, from the sample before
  std::size_t rule = 0;  // of the line
  Closest closest;
};

using Walk = std::vector<Sample>;  // along a chain of lines

// Places along each chain, an eighth of an edge apart beside the boundary, farther away from it, and at all points of
// the lines. `search` is for `edges`. The same for any number of threads.
std::vector<Walk> walksAlong(const std::vector<RuleChain>& chains, const std::vector<NearEdge>& edges,
                             const RulePlane& plane, const EdgeSearch& search, const ItemLoop& loop);

}  // namespace coastmesh
