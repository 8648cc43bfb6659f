#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs of how a mesh hangs together.

// A node in which the mesh touches itself: each fan of triangles there but the largest gets a node of its own, moved
// into it.
void doublePinchedNode(RepairState& state, const FoundDefect& found);

// A triangle without a neighbour; the last one stays.
void takeOutOrphan(RepairState& state, const FoundDefect& found);

// A triangle that goes clockwise; one without area stays.
void turnClockwise(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
