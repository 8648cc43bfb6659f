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

// Refines a mesh made by `constrainedDelaunay(pslg)` until every triangle that no corner of the input excuses holds the
// bounds, or until no further point helps. The result is valid, constrained Delaunay and compact in every case; what
// falls short is in `unresolved`. Ends by itself: every vertex inserted keeps a distance that the input's own spacing
// bounds from below. Throws Cancelled, OutOfRoom, and std::invalid_argument for options beyond their ranges.
RefineStats refine(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control = {});

// The same where free vertices are there already: `notes` are those on the mesh before them, and on them.
RefineStats refine(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                   const RunControl& control = {});

// Takes out and merges vertices that the bounds do not need. REQUIRES: `mesh` as `refine` left it, with the same
// options. `unresolved` in the result replaces that of `refine`. Throws Cancelled.
RefineStats coarsen(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control = {});

// How many vertices that leaves.
std::size_t coarsenedSize(TriMesh mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control = {});

}  // namespace coastmesh
