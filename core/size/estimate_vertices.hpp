#pragma once

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/size_function.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// The number of vertices that the segments of a graph add to a mesh with these lengths, beyond the integral of 2 /
// (sqrt(3) h²) over its interior: half of those along its boundary (the integral includes the other half), and those
// between segments shorter than the requested length and triangles of that length, as many as refinement makes at the
// usual angles. Stops counting soon past `enough`. Lengths are on `surface`.
double verticesOfSegments(const Pslg& pslg, const SizeFunction& size, double enough, const Surface& surface = {},
                          const ItemLoop& loop = inOrder);

}  // namespace coastmesh
