#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs of boundaries: they are taken apart into edges of the mesh, and reassembled.

// The kind of each boundary edge of the mesh, by the grid's boundaries; land if they do not say.
BoundaryKinds takeBoundaryKinds(const Grid& grid);

// The solid edge of the boundary that starts at the defect's node becomes like the open boundary before it.
void openLoneWall(RepairState& state, const FoundDefect& found);

// The grid's boundaries from the kinds of edges.
void rebuildBoundaries(RepairState& state);

// Reports `pending`, the reasons for this rebuilding: one repair for each model and kind.
void reportRebuilt(RepairState& state, std::span<const FoundDefect> pending, std::size_t boundaries_before);

}  // namespace coastmesh
