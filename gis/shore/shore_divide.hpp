#pragma once

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Long straight shores get vertices, so that what is done to one place of them changes nothing farther than an element
// from it. `dropSamples` takes those out again that are not needed.

// A size away from v on either side, where the segment there is longer than two.
void divideBeside(ShoreChains& chains, VertexId v);

// Where lines or points in the water come nearer than half the size, and a size to either side.
void divideAtLines(ShoreChains& chains);

}  // namespace coastmesh
