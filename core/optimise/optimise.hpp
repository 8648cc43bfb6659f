#pragma once

#include "core/pslg.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/submesh_runs.hpp"
#include "core/run_control.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// How often every vertex gets its turn: where lengths are wanted, and where a mesh as good as it gets is asked for
// besides. Vertices at rest are passed over, so that later sweeps cost less.
inline constexpr int kOptimiseSweeps = 6, kMostOptimiseSweeps = 30;

// Makes triangles as near to equilateral, vertices as near to six neighbours and edges as near to the lengths wanted as
// it can: moves free vertices, merges those too near to one another or with too few neighbours, exchanges diagonals.
// Where no lengths are wanted, those that edges have are. Where they are, vertices slide along segments besides, and at
// poor triangles one may come in, unless `max_vertices` is given. Every triangle holds the bounds throughout. REQUIRES:
// `mesh` as `refine` or `coarsen` left it, with the same options. `unresolved` in the result replaces that of before.
// Throws Cancelled.
RefineStats optimise(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, int sweeps,
                     const RunControl& control = {});

// The same for the due vertices of a part of a larger mesh, as `coarsenSubmesh`.
RefineStats optimiseSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, int sweeps,
                            const RunControl& control = {});

}  // namespace coastmesh
