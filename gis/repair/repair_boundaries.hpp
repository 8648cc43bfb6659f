#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs of boundaries: they are taken apart into edges of the mesh, and put together from them again.

// What each edge of the mesh's boundary is, by the grid's boundaries; land where they do not say.
BoundaryKinds takeBoundaryKinds(const Grid& grid);

// The solid edge of the boundary that starts at the defect's node becomes like the opening before it.
void openLoneWall(RepairState& state, const FoundDefect& found);

// The grid's boundaries from the kinds of edges.
void rebuildBoundaries(RepairState& state);

// Reports `pending`, which this rebuilding was for: one repair a model and kind.
void reportRebuilt(RepairState& state, std::span<const FoundDefect> pending, std::size_t boundaries_before);

}  // namespace coastmesh
