#pragma once

#include <vector>

#include "core/refine.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The triangles that break the bounds of `options` although no input angle explains it, in order.
std::vector<Shortfall> findShortfalls(const TriMesh& mesh, const RefineOptions& options);

}  // namespace coastmesh
