#pragma once

#include <map>

#include "gis/projection/scale_table.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Moves the shores of each region of water landwards or seawards, all by the same share of the size wanted, at most a
// tenth, until the water has gained `wanted_m2` square metres (negative: lost). A vertex stays if moving it would make
// an angle, a width or a length worse than wanted, or bring shores nearer to one another than half the size. `moved` is
// called before each move.
void shiftShores(ShoreChains& chains, const std::map<RegionId, double>& wanted_m2, const ScaleTable& scales,
                 const ShoreMove& moved);

}  // namespace coastmesh
