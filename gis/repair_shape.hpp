#pragma once

#include "gis/repair_state.hpp"

namespace coastmesh {

// Repairs of triangles' shapes, and of how many there are round a node: flips and splits.

// A triangle with an angle, an edge or neighbours as the model refuses them.
void reshapeTriangle(RepairState& state, const FoundDefect& found);

// A node with too few or too many triangles.
void mendValence(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
