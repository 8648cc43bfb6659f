#pragma once

#include <vector>

#include "core/pslg.hpp"

namespace coastmesh {

// A point well inside each bounded face that the labels leave outside the domain; none where no segment is labelled.
// REQUIRES: a valid PSLG. Cost O(n log n), and for a face linear in its boundary.
std::vector<Point> holePoints(const Pslg& pslg);

}  // namespace coastmesh
