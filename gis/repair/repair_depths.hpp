#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// A node of an open boundary that is above the water gets the depth of the shallowest neighbour below it; if there is
// none yet, a later round may find one.
void lowerDryOpening(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
