#pragma once

#include <vector>

#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/refine/refine_options.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The triangles that break the bounds of `options` and that no corner of the input excuses, in order.
std::vector<Shortfall> findShortfalls(const TriMesh& mesh, const RefineOptions& options,
                                      const ItemLoop& loop = inOrder);

// The same with two bounds: those that break `asked`; corners are those of `in_reach`.
std::vector<Shortfall> findShortfalls(const TriMesh& mesh, const TriangleBound& asked, const TriangleBound& in_reach,
                                      const ItemLoop& loop = inOrder);

}  // namespace coastmesh
