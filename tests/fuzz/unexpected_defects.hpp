#pragma once

#include <string>
#include <vector>

#include "core/pslg.hpp"
#include "core/refine/check.hpp"
#include "core/refine/refine.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// What `checkMesh` finds in a mesh that `refine` or `coarsen` returned, less the bound violations that `unresolved`
// lists.
std::vector<MeshDefect> unexpectedDefects(const TriMesh& mesh, const Pslg& pslg, const RefineOptions& options,
                                          const std::vector<BoundViolation>& unresolved);

// One line with kind, place (to the last bit) and value.
std::string describe(const MeshDefect& defect);

}  // namespace coastmesh
