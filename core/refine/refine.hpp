#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "core/metric.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/run_control.hpp"
#include "core/size_function.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Refines a mesh made by `constrainedDelaunay(pslg)` until every triangle meets the bounds, except those excused by a
// corner of the input, or until no further point helps. The result is always valid, constrained Delaunay and compact;
// what misses the bounds is in `unresolved`. It terminates: every inserted vertex keeps a minimum distance that depends
// on the input's spacing. Throws Cancelled, OutOfRoom, and std::invalid_argument for options out of range.
RefineStats refine(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control = {});

// The same for a mesh that already has free vertices: `notes` are those on the mesh without them, extended to them.
RefineStats refine(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                   const RunControl& control = {});

// Removes and merges vertices that the bounds do not need. REQUIRES: `mesh` as returned by `refine`, with the same
// options. `unresolved` in the result replaces that of `refine`. Throws Cancelled.
RefineStats coarsen(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control = {});

// The number of vertices after coarsening.
std::size_t coarsenedSize(TriMesh mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control = {});

}  // namespace coastmesh
