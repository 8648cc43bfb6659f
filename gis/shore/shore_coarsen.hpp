#pragma once

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Takes vertices out of boundaries, those that matter least first, until segments are about as long as the size wanted.
// Shores are moved by at most a quarter of the size, or by nearly half of it where segments are much shorter; open
// boundaries by a hundredth. A vertex goes only where its triangle with its neighbours holds no other, so that nothing
// crosses; and where the segment that replaces it comes no nearer to others than half the size, or than what it
// replaces, and makes no small angle in the water.
void coarsenShores(ShoreChains& chains, const ShoreLoss& gone);

}  // namespace coastmesh
