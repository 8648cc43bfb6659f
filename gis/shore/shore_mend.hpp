#pragma once

#include "core/item_loop.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Takes vertices of shores out or moves them, by at most half the size wanted, where a segment is short, an angle of
// the water small, or the water narrow between two shores: in rounds, each change to the better where it is worst,
// until nothing gets better.
// `loop` lends threads.
void mendShores(ShoreChains& chains, const ShoreLoss& gone, const ShoreMove& moved, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
