#pragma once

#include <map>

#include "gis/projection/scale_table.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Moves the shores of each region of water landwards or seawards, all by the same share of the size wanted, a tenth at
// most, until the water has so many square metres more (or less, where that is negative). A vertex stays where moving
// it would make an angle, a width or a length worse than wanted, or bring shores nearer to one another than half the
// size. `moved` is called before each move.
void shiftShores(ShoreChains& chains, const std::map<RegionId, double>& wanted_m2, const ScaleTable& scales,
                 const ShoreMove& moved);

}  // namespace coastmesh
