#pragma once

#include <vector>

#include "core/pslg.hpp"

namespace coastmesh {

// A point well inside each bounded face that is labelled as outside the domain; empty if no segment is labelled.
// REQUIRES: a valid PSLG. Costs O(n log n), and for each face time linear in its boundary.
std::vector<Point> holePoints(const Pslg& pslg);

}  // namespace coastmesh
