#pragma once

#include "core/item_loop.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Repairs shores with short segments, small angles of the water, or narrow water between them, by removing vertices or
// moving them by at most half the size wanted; sharp corners may recede further. In up to 12 rounds, the worst places
// first, until nothing improves; a change improves the worst of these at its place. `loop` provides threads.
void mendShores(ShoreChains& chains, const ShoreLoss& gone, const ShoreMove& moved, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
