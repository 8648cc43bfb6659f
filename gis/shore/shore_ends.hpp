#pragma once

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Mends the ends of open boundaries: a piece of open boundary shorter than half the size wanted becomes shore; a piece
// of shore as short, with land that hardly reaches in, becomes open. Corners of open boundaries stay.
void mendEnds(ShoreChains& chains, const ShoreLoss& gone);

}  // namespace coastmesh
