#pragma once

#include <span>

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs of triangles that are clockwise, and of those listed more than once.

// Turns pieces of clockwise triangles that lie beside their neighbours, not over them. Where the mesh is folded, a node
// that nothing holds is moved so that all triangles round it are counter-clockwise, if there is such a place. One
// without area is kept.
void mendClockwise(RepairState& state, std::span<const FoundDefect> defects);

// Takes out triangles with the same corners as others; returns whether there are any. Before the first round.
// REQUIRES: at least one defect.
bool dropCopies(RepairState& state, std::span<const FoundDefect> defects);

}  // namespace coastmesh
