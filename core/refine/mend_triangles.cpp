#include "core/refine/mend_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// Most relocations of a vertex: a bound on the run, not a setting.
constexpr std::uint8_t kMostMoves = 32;
// From this minimum angle on, merging during refinement pays off, because density spreads.
constexpr double kMergeFromDeg = 35.0;

// True if every place for a vertex that makes a good triangle with the shortest edge is nearer to that edge than the
// input's spacing allows: between two segments that meet at a tiny angle.
bool isOutOfReach(const RefineRun& run, TriId t, const TriangleShape& shape) {
  const EditMesh& mesh = run.mesh;
  const double longest = shape.squared[shape.longest];
  if (isTooLong(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), longest, run.bound)) return false;
  const auto& v = mesh.triangle(t).v;
  const double spacing =
      std::min(run.notes.spacing[v[next3(shape.shortest)]], run.notes.spacing[v[prev3(shape.shortest)]]);
  // The petal's diameter is the edge over the sine.
  const double nearest = kSegmentShare * spacing * run.bound.sin_min;
  return shape.squared[shape.shortest] < nearest * nearest;
}

// Merged vertices may be inserted again: merges are bounded by the insertions and by the mesh's size, so that both end.
bool mayMerge(const RefineRun& run) {
  const auto& types = run.stats.by_type;
  const std::uint64_t put_in = types[0] + types[1] + types[2] + types[3] + run.stats.segment_splits;
  return 10 * run.stats.merges < 3 * put_in && 2 * run.stats.merges < run.mesh.vertexCount();
}

// Algorithm 2: moves a vertex of the triangle to a place where its whole star is good, if there is one. We differ: at
// large bounds a vertex of the shortest edge may also merge with a neighbour. (At 40° 52 of 121,000 attempts with the
// third vertex succeeded.)
bool mendWithoutInsertion(RefineRun& run, TriId t, VertexId beyond_shortest) {
  EditMesh& mesh = run.mesh;
  const Corners corners = mesh.triangle(t).v;
  for (const VertexId v : corners) {
    if (mesh.kind(v) == VertexKind::Input || run.moves[v] >= kMostMoves || !run.ops.relocate(v, run.touched)) continue;
    ++run.moves[v];
    ++run.stats.relocations;
    return true;
  }
  if (run.bound.min_angle < toRadians(kMergeFromDeg) || !mayMerge(run)) return false;
  for (const VertexId v : corners) {
    if (v == beyond_shortest || mesh.kind(v) == VertexKind::Input) continue;
    if (!run.ops.mergeWithNeighbour(v, false, run.touched)) continue;
    ++run.stats.merges;
    return true;
  }
  return false;
}

// True if x sees the subsegment under 180° - 2 alpha or more: the diametral lens of Chew (1993) and Shewchuk (1997) for
// 30°, wider with alpha. A triangle with such an angle is bad, so every encroached subsegment has a bad triangle.
bool isEncroached(double cos_lens, const Frame& at_x, const Point& a, const Point& b) {
  const Point xa = at_x.relative(a), xb = at_x.relative(b);
  const double d = dot(xa, xb);
  if (d >= 0.0) return false;
  if (cos_lens >= 0.0) return true;
  return d * d >= cos_lens * cos_lens * squaredLength(xa) * squaredLength(xb);
}

// True if x lies behind an edge whose mesh is to its left: in the plane, or on the sphere, where the straight edge
// bulges from the chord. Between the two, triangles turn over on the sphere, and no further point would mend them.
bool isBehind(const Frame& at_x, const Point& x, const Point& a, const Point& b) {
  if (orient2d(a, b, x) <= 0) return true;
  if (!at_x.isCurved()) return false;
  const Point xa = at_x.relative(a), xb = at_x.relative(b);
  return dot(xa, xb) < 0.0 && cross(xa, xb) <= 0.0;
}

// The cosine of the smallest angle of triangle abx; x is the frame's origin.
double cosOfLeastAngle(const Frame& at_x, const Point& a, const Point& b) {
  const Point xa = at_x.relative(a), xb = at_x.relative(b), ab = xb - xa;
  const double la = std::sqrt(squaredLength(xa)), lb = std::sqrt(squaredLength(xb)), l = std::sqrt(squaredLength(ab));
  return std::max({dot(xa, xb) / (la * lb), -dot(xa, ab) / (la * l), dot(xb, ab) / (lb * l)});
}

// True if x, to be inserted for t, would make a triangle with an edge that nothing divides whose smallest angle is less
// than t's own, and either less than 20° or at an encroached edge: no further vertex would mend it.
bool spoilsEdge(const RefineRun& run, const Frame& at_x, const Point& a, const Point& b, TriId t) {
  constexpr double kCosSharp = 0.9396926207859084;
  const double least = cosOfLeastAngle(at_x, a, b);
  if (least <= kCosSharp && !isEncroached(run.cos_lens, at_x, a, b)) return false;
  const auto& v = run.mesh.triangle(t).v;
  const Frame at_corner(run.bound.surface, run.mesh.point(v[0]));
  return least > cosOfLeastAngle(at_corner, run.mesh.point(v[1]), run.mesh.point(v[2]));
}

// The subsegment of a cavity's boundary that x, inserted for t, lies behind, or encroaches upon, with the widest angle;
// kNone if there is none.
EdgeRef subsegmentBeside(const RefineRun& run, const Point& x, TriId t, const Patch& cavity) {
  const EditMesh& mesh = run.mesh;
  const Frame at_x(run.bound.surface, x);
  EdgeRef hit = kNone;
  double widest = 0.0;
  for (const BoundaryEdge& r : cavity.boundary) {
    if (r.seg == kNone && r.beyond != kNone) continue;
    const Point &a = mesh.point(r.a), &b = mesh.point(r.b);
    const bool behind = isBehind(at_x, x, a, b);
    if (!behind) {
      const bool is_kept = r.seg != kNone && !mayDivide(run.pslg, r.seg);
      if (is_kept && (r.seg == kFrozen || !spoilsEdge(run, at_x, a, b, t))) continue;
      if (!is_kept && !isEncroached(run.cos_lens, at_x, a, b)) continue;
    }
    const double angle = behind ? std::numbers::pi : angleAt(x, a, b);
    if (angle <= widest) continue;
    widest = angle;
    // The same edge seen from inside the cavity.
    for (const TriId c : cavity.triangles)
      for (unsigned i = 0; i < 3; ++i)
        if (mesh.origin(edgeRef(c, i)) == r.a && mesh.target(edgeRef(c, i)) == r.b) hit = edgeRef(c, i);
  }
  return hit;
}

// Splits the longer side of the small input angle that triangle `filler` fills, for a triangle beyond its base.
bool splitSide(RefineRun& run, TriId filler, VertexId corner, TriId t, unsigned apex) {
  const EditMesh& mesh = run.mesh;
  const unsigned i = mesh.cornerOf(filler, corner);
  const EdgeRef right = edgeRef(filler, prev3(i)), left = edgeRef(filler, next3(i));
  const auto length = [&](EdgeRef e) {
    return run.bound.surface.squaredChord(mesh.point(mesh.origin(e)), mesh.point(mesh.target(e)));
  };
  return splitFor(run, length(right) >= length(left) ? right : left, t, apex);
}

bool insertPoint(RefineRun& run, TriId t, unsigned apex) {
  Patch& patch = run.memory.patch;
  EditMesh& mesh = run.mesh;
  const SteinerPoint candidate = run.search.find(mesh, t, apex);
  if (!std::isfinite(candidate.place.x) || !std::isfinite(candidate.place.y)) return false;
  const EditMesh::Place where = mesh.locate(candidate.place, candidate.near);
  if (where.blocked != kNone) return splitFor(run, where.blocked, t, apex);
  if (where.triangle == kNone) return false;
  const bool inside = mesh.findCavity(candidate.place, where.triangle, patch);
  if (isBarred(run, patch)) {
    defer(run, t);
    return false;
  }
  const EdgeRef hit = subsegmentBeside(run, candidate.place, t, patch);
  if (hit != kNone) return splitFor(run, hit, t, apex);
  const double spacing = spacingAt(run, candidate.place, patch);
  if (!inside || std::min(candidate.squared_clearance, spacing * spacing) < run.squared_resolution) return false;
  if (candidate.squared_clearance < run.variant.free_share * run.variant.free_share * spacing * spacing) return false;
  const VertexId corner = filledCornerBehind(run, t, apex);
  if (corner != kNone)
    for (const TriId c : patch.triangles)
      if (fillsCorner(run, c, corner)) return run.variant.opens_corners && splitSide(run, c, corner, t, apex);

  const std::array<VertexId, 3> corners = mesh.triangle(t).v;
  const VertexId v = mesh.insertInCavity(candidate.place, patch, run.touched);
  noteVertex(run, v, spacing, corners[0]);
  // A point on the triangle's own circumcircle leaves it there, as obtuse as before. With sizes, optimisation mends it.
  if (run.options.size == nullptr && mesh.triangle(t).v == corners) run.touched.push_back(t);
  ++run.stats.by_type[static_cast<unsigned>(candidate.type)];
  enqueueTouched(run);
  return true;
}

void mend(RefineRun& run, TriId t) {
  EditMesh& mesh = run.mesh;
  const TriangleShape shape(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), run.bound.surface);
  if (!isBad(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), run.bound)) return;
  const auto isFrozen = [&](VertexId v) { return v < run.frozen.size() && run.frozen[v]; };
  if (std::ranges::any_of(mesh.triangle(t).v, isFrozen)) return defer(run, t);
  const VertexId corner = mesh.triangle(t).v[shape.shortest];
  if (fillsCorner(run, t, corner)) {
    // Its angles cannot be improved, but its sides may be too long.
    if (isTooLong(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), shape.squared[shape.longest], run.bound))
      splitSide(run, t, corner, t, shape.shortest);
    return;
  }
  // If edges are only too long there are too few vertices, so moves do not help.
  const bool is_only_long =
      run.options.size != nullptr && !isBad(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), run.strict);
  if (run.options.algorithm == Algorithm::Relocate && !is_only_long && mendWithoutInsertion(run, t, corner)) {
    enqueueTouched(run);
    return;
  }
  if (!isOutOfReach(run, t, shape)) insertPoint(run, t, shape.shortest);
}

// Number by number: `==` calls memcmp.
bool isCurrent(const RefineRun& run, const BadTriangle& bad) {
  const Corners& now = run.mesh.triangle(bad.triangle).v;
  return now[0] == bad.corners[0] && now[1] == bad.corners[1] && now[2] == bad.corners[2];
}

// In a piece, other pieces may leave vertices for what its share does not allow: its triangles wait for the next round.
void endForLackOfVertices(RefineRun& run, const BadTriangle& next) {
  run.stats.budget_reached = true;
  if (!run.variant.clear_of_frozen) return;
  defer(run, next.triangle);
  while (!run.queue.empty())
    if (const BadTriangle bad = run.queue.pop(); isCurrent(run, bad)) defer(run, bad.triangle);
}

void drainQueue(RefineRun& run, const RunControl& control) {
  EditMesh& mesh = run.mesh;
  std::uint64_t steps = 0;
  while (!run.queue.empty()) {
    if (++steps % 1024 == 0)
      control.checkpoint(static_cast<double>(steps) / static_cast<double>(steps + run.queue.size()));
    const BadTriangle bad = run.queue.pop();
    if (!isCurrent(run, bad)) continue;
    if (mesh.vertexCount() >= run.options.max_vertices) return endForLackOfVertices(run, bad);
    if (mesh.vertexCount() > run.options.most_in_memory) throw OutOfRoom(mesh.point(bad.corners[0]));
    mend(run, bad.triangle);
  }
}

}  // namespace

void refineAll(RefineRun& run, const RunControl& control) {
  for (TriId t = 0; t < run.mesh.triangleSlots(); ++t)
    if (run.mesh.isLive(t)) enqueueIfBad(run, t);
  drainQueue(run, control);
}

void resume(RefineRun& run, std::vector<TriId>& touched, const RunControl& control) {
  run.touched.swap(touched);
  enqueueTouched(run);
  drainQueue(run, control);
}

}  // namespace coastmesh
