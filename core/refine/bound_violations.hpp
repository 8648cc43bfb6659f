#pragma once

#include <vector>

#include "core/input_corners.hpp"
#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/refine/refine_options.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The triangles that break the bounds of `options` and that no corner of the input excuses, in order.
std::vector<BoundViolation> findBoundViolations(const TriMesh& mesh, const RefineOptions& options,
                                                const ItemLoop& loop = inOrder);

struct BoundJudgement {
  BoundCounts counts;
  std::vector<BoundViolation> unresolved;  // what nothing excuses, in order
};

// All triangles that break `asked`; corners are those of `in_reach`.
BoundJudgement judgeBounds(const TriMesh& mesh, const TriangleBound& asked, const TriangleBound& in_reach,
                           const ItemLoop& loop = inOrder);

}  // namespace coastmesh
