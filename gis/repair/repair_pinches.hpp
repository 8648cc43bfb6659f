#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs of a mesh's topology.

// A node where the mesh touches itself: each fan of triangles there except the largest gets its own node, moved into
// it.
void doublePinchedNode(RepairState& state, const FoundDefect& found);

// A triangle without a neighbour; the last one is kept.
void takeOutOrphan(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
