#pragma once

#include <span>
#include <vector>

#include "core/refine/refine_run.hpp"
#include "core/run_control.hpp"

namespace coastmesh {

// Processes bad triangles until no insertion can improve any.
void refineAll(RefineRun& run, const RunControl& control);
// Processes the bad ones among these triangles, and all that become bad.
void resume(RefineRun& run, std::vector<TriId>& touched, const RunControl& control);

// At input angles too small for the bounds (corner_triangles.cpp) ----------------------------------------------------

// True if a triangle fills such an angle at its corner `apex`; then it cannot be improved.
bool fillsCorner(const RefineRun& run, TriId t, VertexId apex);
// The apex of the small input angle filled by the triangle beyond t's shortest edge, which is opposite corner `apex` of
// t; kNone if there is none.
VertexId filledCornerBehind(const RefineRun& run, TriId t, unsigned apex);
// The triangle that fills such an angle, and the strip beyond it up to the last triangle that misses the bounds, as
// long as all corners are on the two sides of the angle. Empty if t fills no such angle, or none misses the bounds.
std::vector<TriId> shortCornerStrip(const RefineRun& run, TriId t);
// The effect on triangles beyond the sides of an input angle when the triangle that fills it grows.
enum class Beyond { StaysGood, GetsMended };
// Removes split points until the triangle that fills the angle reaches the first good ones. The part in between is too
// thin to be meshed well, so one triangle covers it.
void growCornerTriangles(RefineRun& run, Beyond beyond, const RunControl& control);

// Splitting subsegments (split_subsegment.cpp) -----------------------------------------------------------------------

// The ends of a subsegment get no closer to each other than this share of the input's spacing.
inline constexpr double kSegmentShare = 0.02;
// Splits a subsegment that blocks a point for t, whose shortest edge is opposite its corner `apex`. Returns whether it
// did.
bool splitFor(RefineRun& run, EdgeRef edge, TriId t, unsigned apex);

// What the queue leaves (repair.cpp) ---------------------------------------------------------------------------------

// Repairs what refinement left bad: takes the patch around such a triangle, refines it again in several ways, uses the
// smallest result without a bad triangle, and enlarges the patch if none succeeds. Such places are normally few and far
// apart, so it can be thorough; if not, the bound is out of reach, and work is limited in proportion to that of
// refinement. Triangles in `given_up`, ordered by number, are left as they are.
void repair(RefineRun& run, const RunControl& control, std::span<const BadTriangle> given_up = {});

}  // namespace coastmesh
