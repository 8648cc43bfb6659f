#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs the topology of a mesh.

// Repairs a node where the mesh touches itself: each fan of triangles except the largest gets a copy of the node, moved
// into the fan.
void doublePinchedNode(RepairState& state, const FoundDefect& found);

// Removes a triangle without a neighbour, unless it is the grid's only one.
void takeOutOrphan(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
