#pragma once

#include "core/pslg.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/submesh_runs.hpp"
#include "core/run_control.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Number of sweeps if lengths are requested, and for the longest optimisation. Vertices at rest are skipped, so that
// later sweeps cost less.
inline constexpr int kOptimiseSweeps = 6, kMostOptimiseSweeps = 30;

// Makes triangles as equilateral, numbers of neighbours as close to six and edges as close to the requested lengths as
// possible: moves free vertices, merges those too close to one another or with too few neighbours, exchanges diagonals.
// Without requested lengths, edges keep theirs. With them, vertices also slide along segments, and one may be inserted
// at poor triangles, unless `max_vertices` is set. Every triangle stays within the bounds. REQUIRES: `mesh` as returned
// by `refine` or `coarsen`, with the same options. `unresolved` in the result replaces the earlier one. Throws
// Cancelled.
RefineStats optimise(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, int sweeps,
                     const RunControl& control = {});

// The same for the due vertices of a part of a larger mesh, like `coarsenSubmesh`.
RefineStats optimiseSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, int sweeps,
                            const RunControl& control = {});

}  // namespace coastmesh
