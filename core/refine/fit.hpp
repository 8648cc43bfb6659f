#pragma once

#include "core/pslg.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/submesh_runs.hpp"
#include "core/run_control.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// How often every vertex gets its turn: where lengths are wanted, to take out what is too near to one another; and where a smooth mesh
// is asked for besides.
inline constexpr int kFitSweeps = 2, kSmoothSweeps = 10;

// Brings edges to the lengths wanted: moves free vertices, merges those too near to one another. Where no lengths are wanted, evens them
// out. A vertex moves only where every triangle round it holds the bounds then. REQUIRES: `mesh` as `refine` or `shrink` left it,
// with the same options. `unresolved` in the result replaces that of before. Throws Cancelled.
RefineStats fit(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, int sweeps,
                const RunControl& control = {});

// The same for the due vertices of a part of a larger mesh, as `shrinkSubmesh`.
RefineStats fitSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, int sweeps,
                       const RunControl& control = {});

}  // namespace coastmesh
