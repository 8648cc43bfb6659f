#pragma once

#include <span>
#include <vector>

#include "core/input_corners.hpp"
#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/refine/refine_options.hpp"
#include "core/space_point.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The triangles that break the bounds of `options` and that no corner of the input excuses, in order.
std::vector<BoundViolation> findBoundViolations(const TriMesh& mesh, const RefineOptions& options,
                                                const ItemLoop& loop = inOrder);

// The same as triangles; `corners` are those of the input, null where there are none.
std::vector<TriId> trianglesInViolation(const TriMesh& mesh, const RefineOptions& options, const InputCorners* corners,
                                        const ItemLoop& loop = inOrder);

struct BoundJudgement {
  BoundCounts counts;                      // of what breaks the bounds on angles
  std::vector<BoundViolation> unresolved;  // what breaks any and nothing excuses, in order
};

// All triangles that break `asked`, with the angles of flat triangles between `places`, one a point of the mesh, where
// there are any, else on the bound's surface; lengths are the surface's. Corners are those of `in_reach`, in the plane.
BoundJudgement judgeBounds(const TriMesh& mesh, const TriangleBound& asked, const TriangleBound& in_reach,
                           const ItemLoop& loop = inOrder, std::span<const SpacePoint> places = {});

// Of a finished mesh: refinement aims slightly above the bounds, here they themselves count, less `slack_deg` for what
// rounding made of coordinates. `size_max` in units of the surface; places as above.
BoundJudgement judgeFinished(const TriMesh& mesh, double min_angle_deg, double max_angle_deg, double size_max,
                             double slack_deg = 0.0, const ItemLoop& loop = inOrder, const Surface& surface = {},
                             std::span<const SpacePoint> places = {});

}  // namespace coastmesh
