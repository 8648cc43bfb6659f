#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs of triangles' shapes, and of their number around a node: flips, splits and moves of nodes.

// A triangle with an angle, an edge or neighbours that the model rejects.
void reshapeTriangle(RepairState& state, const FoundDefect& found);

// An edge with the centres of its triangles too close to one another: a small move of a node is tried too.
void lengthenFlowLink(RepairState& state, const FoundDefect& found);

// A node with too few or too many triangles. A triangle with too short a time
// step.
void lengthenEdges(RepairState& state, const FoundDefect& found);

// A clockwise triangle that lies over its neighbours: one of its nodes is where it should not be. A node that nothing
// holds is moved to the middle between two of its neighbours from where all triangles round it are counter-clockwise.
void unfoldTriangle(RepairState& state, const FoundDefect& found);

// Whether the triangle's smallest angle can be increased.
bool relaxTriangle(RepairState& state, std::uint32_t t);

void mendValence(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
