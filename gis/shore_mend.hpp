#pragma once

#include <functional>

#include "gis/shore_chains.hpp"

namespace coastmesh {

// Takes vertices of shores out or moves them, by at most half the size wanted, where a segment is short, an angle of the water small, or
// the water narrow between two shores: in rounds, each change to the better where it is worst, until nothing gets better.
// `gone` and `moved` are called with each vertex and the region of its water.
void mendShores(ShoreChains& chains, const std::function<void(VertexId, RegionId)>& gone,
                const std::function<void(VertexId, RegionId)>& moved);

}  // namespace coastmesh
