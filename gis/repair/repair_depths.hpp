#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Gives a node of an open boundary that is above the water the depth of its shallowest neighbour below water. Does
// nothing if there is none yet: a later round may find one.
void lowerDryOpening(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
