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

// The triangles that miss the bounds of `options` and that no corner of the input excuses, in order.
std::vector<BoundViolation> findBoundViolations(const TriMesh& mesh, const RefineOptions& options,
                                                const ItemLoop& loop = inOrder);

// The same as triangles; `corners` are those of the input, null if there are none.
std::vector<TriId> trianglesInViolation(const TriMesh& mesh, const RefineOptions& options, const InputCorners* corners,
                                        const ItemLoop& loop = inOrder);

struct BoundJudgement {
  BoundCounts counts;                      // counts for the bounds on angles
  std::vector<BoundViolation> unresolved;  // triangles that miss any bound without excuse, in order
};

// Judges triangles that miss `asked`. Angles are those of flat triangles between `places`, one for each point of the
// mesh, if given, otherwise on the bound's surface, as lengths are. Corners are those that `in_reach` cannot divide, in
// the plane.
BoundJudgement judgeBounds(const TriMesh& mesh, const TriangleBound& asked, const TriangleBound& in_reach,
                           const ItemLoop& loop = inOrder, std::span<const SpacePoint> places = {});

// For a finished mesh: refinement aims slightly above the bounds; here the bounds themselves apply, less `slack_deg`
// for the rounding of coordinates. `size_max` in units of the surface; places as above.
BoundJudgement judgeFinished(const TriMesh& mesh, double min_angle_deg, double max_angle_deg, double size_max,
                             double slack_deg = 0.0, const ItemLoop& loop = inOrder, const Surface& surface = {},
                             std::span<const SpacePoint> places = {});

}  // namespace coastmesh
