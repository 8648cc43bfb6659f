#pragma once

#include <string>
#include <vector>

#include "core/pslg.hpp"
#include "core/refine/check.hpp"
#include "core/refine/refine.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Defects that `checkMesh` finds in a mesh returned by `refine` or `coarsen`, without the bound violations in
// `unresolved`.
std::vector<MeshDefect> unexpectedDefects(const TriMesh& mesh, const Pslg& pslg, const RefineOptions& options,
                                          const std::vector<BoundViolation>& unresolved);

// One line: kind, place with all digits, and value.
std::string describe(const MeshDefect& defect);

}  // namespace coastmesh
