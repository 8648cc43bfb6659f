#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/refine/mend_triangles.hpp"

namespace coastmesh {

namespace {

bool shareAnEnd(const Segment& p, const Segment& q) { return p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b; }

// Like spacingAt, for a point that splits a subsegment: other segments beside it count too.
double spacingOnSegment(const RefineRun& run, const Point& x, EdgeRef edge, const Patch& cavity) {
  const EditMesh& mesh = run.mesh;
  double spacing = spacingAt(run, x, cavity);
  for (const VertexId v : {mesh.origin(edge), mesh.target(edge)})
    spacing = std::min(spacing, run.notes.spacing[v] + run.bound.surface.chord(x, mesh.point(v)));
  const Segment& own = run.pslg.segments[mesh.segment(edge)];
  for (const BoundaryEdge& r : cavity.boundary) {
    if (r.seg >= run.pslg.segments.size()) continue;
    // Near a common end two segments are arbitrarily close: there the spacing of that vertex counts.
    const Segment& other = run.pslg.segments[r.seg];
    if (shareAnEnd(own, other)) continue;
    spacing = std::min(spacing, distanceToSegment(run.bound.surface, x, mesh.point(r.a), mesh.point(r.b)));
  }
  return spacing;
}

// True if the segment shares an end with one that ends at the vertex: near that end they are arbitrarily close.
bool isConnected(const RefineRun& run, VertexId v, const Segment& segment) {
  const EditMesh& mesh = run.mesh;
  std::vector<EdgeRef> opposite;
  mesh.star(v, opposite);
  return std::ranges::any_of(opposite, [&](EdgeRef e) {
    return std::ranges::any_of(
        std::array{edgeRef(triOf(e), next3(indexOf(e))), edgeRef(triOf(e), prev3(indexOf(e)))}, [&](EdgeRef at_v) {
          const SegmentId s = mesh.segment(at_v);
          return s != kNone && (s >= run.pslg.segments.size() || shareAnEnd(run.pslg.segments[s], segment));
        });
  });
}

// Of several vertices of the input beside a long segment only one has a triangle with it at first. Others note how
// close it is once it is divided.
void noteSegmentBeside(RefineRun& run, EdgeRef edge, const Patch& cavity) {
  const EditMesh& mesh = run.mesh;
  const Segment& own = run.pslg.segments[mesh.segment(edge)];
  const Point &a = run.pslg.points[own.a], &b = run.pslg.points[own.b];
  for (const BoundaryEdge& r : cavity.boundary) {
    if (mesh.kind(r.a) != VertexKind::Input) continue;
    double& spacing = run.notes.spacing[r.a];
    const double gap = distanceToSegment(run.bound.surface, mesh.point(r.a), a, b);
    if (gap < spacing && !isConnected(run, r.a, own)) spacing = gap;
  }
}

// Converts a share of an edge's length on the surface to one of its length in the plane, by the ratio of its two
// pieces' chords.
double shareInPlane(const Surface& surface, const Point& a, const Point& b, double share) {
  if (!surface.isCurved()) return share;
  const double to_a = share * std::sqrt(surface.shrinkAt(b)), to_b = (1.0 - share) * std::sqrt(surface.shrinkAt(a));
  return to_a / (to_a + to_b);
}

Point splitPlace(const RefineRun& run, VertexId a, VertexId b, SegmentId seg) {
  const EditMesh& mesh = run.mesh;
  const auto unit = [&](VertexId v) { return v < mesh.inputVertices() ? run.notes.shell_unit[v] : 0.0; };
  const Point &pa = mesh.point(a), &pb = mesh.point(b);
  double share = 0.5;
  if ((unit(a) > 0.0) != (unit(b) > 0.0)) {
    // On the shell around the small angle whose radius, the unit times a power of two, is closest to half the length.
    const double length = run.bound.surface.chord(pa, pb);
    const double radius_unit = std::max(unit(a), unit(b));
    const double radius = radius_unit * std::exp2(std::round(std::log2(0.5 * length / radius_unit)));
    const double from = std::clamp(radius / length, 0.25, 0.75);
    share = unit(a) > 0.0 ? from : 1.0 - from;
  }
  const Point &sa = run.pslg.points[run.pslg.segments[seg].a], &sb = run.pslg.points[run.pslg.segments[seg].b];
  return projectedOnLine(pa + shareInPlane(run.bound.surface, pa, pb, share) * (pb - pa), sa, sb);
}

// Removes the free vertices in the subsegment's diametral circle (Chew 1993). Returns the subsegment, which may then be
// an edge of another triangle.
EdgeRef clearDiametralCircle(RefineRun& run, EdgeRef edge) {
  EditMesh& mesh = run.mesh;
  const VertexId a = mesh.origin(edge), b = mesh.target(edge);
  for (int side = 0; side < 2; ++side) {
    // Every round removes a vertex.
    while (edge != kNone) {
      const VertexId v = mesh.apex(edge);
      const Frame at_v(run.bound.surface, mesh.point(v));
      if (mesh.kind(v) != VertexKind::Free || dot(at_v.relative(mesh.point(a)), at_v.relative(mesh.point(b))) >= 0.0)
        break;
      const VertexId from = mesh.origin(edge);
      if (!removeFreeVertex(run, v)) break;
      ++run.stats.removals;
      edge = kNone;
      for (const TriId t : run.touched) {
        if (!mesh.isLive(t)) continue;
        for (unsigned i = 0; i < 3; ++i)
          if (mesh.segment(edgeRef(t, i)) != kNone && mesh.origin(edgeRef(t, i)) == from &&
              mesh.target(edgeRef(t, i)) == (from == a ? b : a))
            edge = edgeRef(t, i);
      }
    }
    if (side == 0 && edge != kNone && mesh.twin(edge) != kNone) edge = mesh.twin(edge);
  }
  return edge;
}

}  // namespace

bool splitFor(RefineRun& run, EdgeRef edge, TriId t, unsigned apex) {
  Patch& patch = run.memory.patch;
  EditMesh& mesh = run.mesh;
  const SegmentId seg = mesh.segment(edge);
  if (!mayDivide(run.pslg, seg)) {
    if (seg == kFrozen && run.variant.clear_of_frozen) defer(run, t);
    return false;
  }
  const VertexId a = mesh.origin(edge), b = mesh.target(edge);
  const VertexId corner = filledCornerBehind(run, t, apex);
  if (corner != kNone && (a == corner || b == corner) && !run.variant.opens_corners) return false;
  const Point place = splitPlace(run, a, b, seg);
  if (run.stuck.contains({a, b}) || !mesh.findSplitCavity(edge, place, patch)) return false;
  if (isBarred(run, patch)) {
    defer(run, t);
    return false;
  }
  const double spacing = spacingOnSegment(run, place, edge, patch);
  const Surface& surface = run.bound.surface;
  const double nearer =
      std::min(surface.squaredChord(place, mesh.point(a)), surface.squaredChord(place, mesh.point(b)));
  // Where the input itself is finer than the resolution, nothing can be repaired.
  if (std::min(nearer, spacing * spacing) < run.squared_resolution) return false;
  if (nearer < kSegmentShare * kSegmentShare * spacing * spacing) return false;
  noteSegmentBeside(run, edge, patch);
  const EdgeRef cleared = clearDiametralCircle(run, edge);
  const VertexId v = cleared == kNone ? kNone : mesh.splitSegment(cleared, place, run.touched);
  if (v != kNone) {
    noteVertex(run, v, spacing, a);
    ++run.stats.segment_splits;
    // The triangle that required the split may still exist and be bad.
    run.touched.push_back(t);
  }
  if (v == kNone) {
    // Vertices may have been removed in vain; trying again would repeat that.
    run.stuck.insert({a, b});
    run.stuck.insert({b, a});
  }
  std::ranges::sort(run.touched);
  run.touched.erase(std::unique(run.touched.begin(), run.touched.end()), run.touched.end());
  enqueueTouched(run);
  return v != kNone;
}

}  // namespace coastmesh
