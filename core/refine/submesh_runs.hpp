#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/submesh.hpp"

namespace coastmesh {

// Work on a submesh while others work on the rest of its mesh. Nothing next to a frozen edge is changed, so that
// submeshes stay Delaunay with their neighbours whatever is done there. What would have to change at a frozen edge
// stays due until the mesh is cut elsewhere.

// Processes the bad ones of the due triangles, and all that become bad; with `mends` also repairs the rest. Triangles
// blocked by a frozen edge, or by `options.max_vertices`, which applies to the submesh, are due afterwards. Bad
// triangles that are not due, before or after, cannot be improved by any point. `steiner_points` and `unresolved` stay
// empty. Throws Cancelled.
RefineStats refineSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, bool mends,
                          const RunControl& control = {});

// Only repairs: patches around bad triangles are refined again, nothing else is changed. Triangles blocked by a frozen
// edge are due afterwards.
RefineStats repairSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, const RunControl& control);

// Removes and merges the due vertices that the bounds do not need. Those that a frozen edge blocked are due afterwards;
// due triangles and notes are not kept. Throws Cancelled.
RefineStats coarsenSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options,
                           const RunControl& control = {});

// Releases the submesh that was worked on in `mesh`. Of its due vertices (one flag for each slot) those stay due that
// are fixed or next to a frozen edge, and those in `waiting`.
MeshState releaseDue(EditMesh& mesh, std::vector<std::uint8_t> due, std::span<const VertexId> waiting = {});

}  // namespace coastmesh
