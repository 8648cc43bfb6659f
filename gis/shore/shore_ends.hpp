#pragma once

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Where shores meet an open boundary: a piece of that shorter than half the size wanted becomes shore, and so short a
// piece of shore, of land that hardly reaches in, becomes open. Corners of the open boundary stay.
void mendEnds(ShoreChains& chains, const ShoreLoss& gone);

}  // namespace coastmesh
