#pragma once

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Removing and moving vertices by shares of the size would enlarge water that is smaller than an element. These reduce
// the sizes at its shore, and the least lengths, to its mean width.

// For waters smaller than a disk as wide as the size. The mean width may be too small if the shore has fine detail, so
// few other waters would be safe to limit before it is removed.
void limitToSmallWaters(ShoreChains& chains);

// For waters whose mean width is less than half the size. Few waters that were opened for the size are so narrow.
// REQUIRES: detail finer than the size was removed.
void limitToNarrowWaters(ShoreChains& chains);

}  // namespace coastmesh
