#pragma once

#include <span>

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs triangles that are clockwise, or listed more than once.

// Turns connected pieces of clockwise triangles that lie beside their neighbours, not over them. If the mesh is folded,
// a node is moved instead (`unfoldTriangle`). Triangles without area stay as they are.
void mendClockwise(RepairState& state, std::span<const FoundDefect> defects);

// Removes triangles with the same corners as others, keeping a counter-clockwise one if there is one; returns whether
// it removed any. Call before the first round. REQUIRES: at least one defect.
bool dropCopies(RepairState& state, std::span<const FoundDefect> defects);

}  // namespace coastmesh
