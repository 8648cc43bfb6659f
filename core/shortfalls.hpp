#pragma once

#include <vector>

#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/refine.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The triangles that break the bounds of `options` although no input angle explains it, in order.
std::vector<Shortfall> findShortfalls(const TriMesh& mesh, const RefineOptions& options,
                                      const ItemLoop& loop = inOrder);

// The same with two bounds: those that break `asked` although an input angle does not stand in the way of `in_reach`.
std::vector<Shortfall> findShortfalls(const TriMesh& mesh, const TriangleBound& asked, const TriangleBound& in_reach,
                                      const ItemLoop& loop = inOrder);

}  // namespace coastmesh
