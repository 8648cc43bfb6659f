#pragma once

#include <span>

#include "core/refine/refine_run.hpp"
#include "core/run_control.hpp"

namespace coastmesh {

// Mends what refinement left short of the bounds: takes the patch round such a triangle, refines it anew in several
// ways, keeps the smallest result without a bad triangle, and widens the patch where none succeeds. Places are few and
// far apart, so it can be thorough; where they are not, the bound is out of reach, and the work is cut off in
// proportion to that of the refinement. Triangles in `given_up`, in the order of their numbers, are left as they are.
void repair(RefineRun& run, const RunControl& control, std::span<const BadTriangle> given_up = {});

}  // namespace coastmesh
