#pragma once

#include <span>
#include <vector>

#include "core/refine/refine_run.hpp"
#include "core/run_control.hpp"

namespace coastmesh {

// Handles bad triangles until none is left that a point could mend.
void refineAll(RefineRun& run, const RunControl& control);
// Handles the bad ones among these triangles, and what follows from that.
void resume(RefineRun& run, std::vector<TriId>& touched, const RunControl& control);

// At input angles too small for the bounds (corner_triangles.cpp) ----------------------------------------------------

// Whether a triangle fills such an angle, its smallest one there; it cannot be mended.
bool fillsCorner(const RefineRun& run, TriId t, VertexId apex);
// The apex of the small input angle whose triangle lies behind the edge opposite corner `apex` of t, its shortest;
// kNone where there is none.
VertexId filledCornerBehind(const RefineRun& run, TriId t, unsigned apex);
// The triangle that fills such an angle, and those beyond it up to the last one that falls short: they form a strip as
// long as each has all its corners on the two sides of the angle. Empty where t fills no such angle, or none falls
// short.
std::vector<TriId> shortCornerStrip(const RefineRun& run, TriId t);
// What becomes of the other sides of the segments at an input angle when its triangle grows.
enum class Beyond { StaysGood, GetsMended };
// Takes split points out until the triangle that fills the angle reaches to where good ones begin. What lies between is
// too thin to be meshed well, and that one triangle does for all of it.
void growCornerTriangles(RefineRun& run, Beyond beyond, const RunControl& control);

// Splitting subsegments (split_subsegment.cpp) -----------------------------------------------------------------------

// The ends of a subsegment come no nearer to one another than this share of the input's spacing.
inline constexpr double kSegmentShare = 0.02;
// Splits a subsegment that keeps a point from mending t, whose shortest edge is opposite its corner `apex`.
bool splitFor(RefineRun& run, EdgeRef edge, TriId t, unsigned apex);

// What the queue leaves (repair.cpp) ---------------------------------------------------------------------------------

// Mends what refinement left short of the bounds: takes the patch round such a triangle, refines it anew in several
// ways, keeps the smallest result without a bad triangle, and widens the patch where none succeeds. Places are few and
// far apart, so it can be thorough; where they are not, the bound is out of reach, and the work is cut off in
// proportion to that of the refinement. Triangles in `given_up`, in the order of their numbers, are left as they are.
void repair(RefineRun& run, const RunControl& control, std::span<const BadTriangle> given_up = {});

}  // namespace coastmesh
