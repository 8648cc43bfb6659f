#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs of triangles' shapes, and of how many there are round a node: flips, splits and moves of nodes.

// A triangle with an angle, an edge or neighbours as the model refuses them.
void reshapeTriangle(RepairState& state, const FoundDefect& found);

// An edge with the centres of its triangles too near to one another: a little move of a node is tried too.
void lengthenFlowLink(RepairState& state, const FoundDefect& found);

// A node with too few or too many triangles.
// For a triangle that leaves too short a time step.
void lengthenEdges(RepairState& state, const FoundDefect& found);

// Whether the triangle's smallest angle could be made larger.
bool relaxTriangle(RepairState& state, std::uint32_t t);

void mendValence(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
