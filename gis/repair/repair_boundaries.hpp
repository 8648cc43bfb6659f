#pragma once

#include "gis/repair/repair_state.hpp"

namespace coastmesh {

// Repairs boundaries: they are taken apart into edges of the mesh and reassembled.

// The kind of each boundary edge of the mesh, from the grid's boundaries; land if an edge is in none.
BoundaryKinds takeBoundaryKinds(const Grid& grid, const TriMesh& mesh);

// Gives the solid boundary edge that starts at the defect's node the kind of the open boundary there.
void openLoneWall(RepairState& state, const FoundDefect& found);

// Sets the grid's boundaries from the kinds of edges.
void rebuildBoundaries(RepairState& state);

// Reports the rebuilding: one repair for each model and kind of defect in `pending`, the defects that caused it.
void reportRebuilt(RepairState& state, std::span<const FoundDefect> pending, std::size_t boundaries_before);

}  // namespace coastmesh
