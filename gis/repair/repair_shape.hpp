#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs the shapes of triangles, and their number around a node: flips, splits and moves of nodes.

// Repairs a triangle with an angle, an edge or neighbours that the model rejects: flips and splits, then small moves of
// nodes too. A corner of the boundary that is too sharp for two triangles with the minimum angle is cut off
// (`cornerCutOf`), and one that nothing else repairs.
void reshapeTriangle(RepairState& state, const FoundDefect& found);

// Repairs an edge whose triangles have their centres too close together. Small moves of nodes are tried at once.
void lengthenFlowLink(RepairState& state, const FoundDefect& found);

// Repairs a triangle with too short a time step: moves of its nodes and collapses of its edges.
void lengthenEdges(RepairState& state, const FoundDefect& found);

// Repairs a clockwise triangle that overlaps its neighbours because one of its nodes is misplaced. Moves an inner node
// without fixed edges to the midpoint between two of its neighbours that makes all triangles around it
// counter-clockwise, with the largest smallest angle.
void unfoldTriangle(RepairState& state, const FoundDefect& found);

// Increases the triangle's smallest angle if an edit can; returns whether one did.
bool relaxTriangle(RepairState& state, std::uint32_t t);

// For a triangle whose smallest angle no single edit increases: moves nodes up to three edges away, if that lets fewer
// triangles miss the minimum angle; returns whether it did. Call after `startRound`; the triangles keep their corners.
bool shareSmallAngle(RepairState& state, std::uint32_t t);

void mendValence(RepairState& state, const FoundDefect& found);

}  // namespace coastmesh
