#pragma once

#include "core/pslg.hpp"
#include "core/size_function.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// How many vertices the segments of a graph add to a mesh with these lengths, beyond the integral of 2 / (sqrt(3) h²)
// over its inside: half of those along its boundary (of which that integral counts the other half), and those that lead
// from segments shorter than wanted to triangles as large as wanted, as many as refinement makes at the usual angles.
// Stops counting past `enough`. The lengths are those on `surface`.
double verticesOfSegments(const Pslg& pslg, const SizeFunction& size, double enough, const Surface& surface = {});

}  // namespace coastmesh
