#pragma once

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Adds vertices to long straight shores, so that a change in one place has no effect more than an element away.
// `dropSamples` removes those that turn out not to be needed.

// Adds a vertex one size from v on either side, if the segment there is longer than two.
void divideBeside(ShoreChains& chains, VertexId v);

// Adds vertices where lines or points in the water come within half the size, and one size further on either side.
void divideAtLines(ShoreChains& chains);

}  // namespace coastmesh
