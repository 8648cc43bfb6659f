#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/submesh.hpp"

namespace coastmesh {

// Work on a submesh while others work on the rest of its mesh. Nothing next to a frozen edge is changed, so that every
// submesh stays Delaunay with its neighbours whatever these do; what would have to be changed there is due, and waits
// for the mesh to be cut elsewhere.

// Handles the bad ones of the due triangles, and what follows from that; with `mends` also repairs what that leaves.
// Afterwards those that a frozen edge was in the way of are due. Bad triangles that are not due, before or after, are
// such that no point helps. `options.max_vertices` counts the submesh's own. `steiner_points` and `unresolved` of the
// result stay empty. Throws Cancelled.
RefineStats refineSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, bool mends,
                          const RunControl& control = {});

// Repairs alone: patches round bad triangles are solved anew, nothing else is touched. What a frozen edge was in the
// way of is due afterwards.
RefineStats repairSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, const RunControl& control);

// Takes out and merges the due vertices where the bounds do not need them. Afterwards those that a frozen edge was in
// the way of are due; due triangles and notes are not kept. Throws Cancelled.
RefineStats coarsenSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options,
                           const RunControl& control = {});

// The submesh that was worked on in `mesh`. Of its due vertices (one a slot) those stay due that a frozen edge holds,
// or runs beside, and those that are `waiting`.
MeshState releaseDue(EditMesh& mesh, std::vector<std::uint8_t> due, std::span<const VertexId> waiting = {});

}  // namespace coastmesh
