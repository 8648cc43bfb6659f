#include <algorithm>
#include <cmath>

#include "core/refine/refiner.hpp"

namespace coastmesh {

// As spacingAt, for a point that is to split a subsegment, where the other segments beside it count too.
double Refiner::spacingOnSegment(const Point& x, EdgeRef edge, const Patch& cavity) const {
  double spacing = spacingAt(x, cavity);
  for (const VertexId v : {mesh_.origin(edge), mesh_.target(edge)})
    spacing = std::min(spacing, notes_.spacing[v] + distance(x, mesh_.point(v)));
  const Segment& own = pslg_.segments[mesh_.segment(edge)];
  for (const BoundaryEdge& r : cavity.boundary) {
    if (r.seg >= pslg_.segments.size()) continue;
    // Near a common end two segments are arbitrarily close: there the spacing of that vertex counts.
    const Segment& other = pslg_.segments[r.seg];
    if (own.a == other.a || own.a == other.b || own.b == other.a || own.b == other.b) continue;
    spacing = std::min(spacing, std::sqrt(squaredDistanceToSegment(x, mesh_.point(r.a), mesh_.point(r.b))));
  }
  return spacing;
}

Point Refiner::splitPlace(VertexId a, VertexId b, SegmentId seg) const {
  const auto unit = [&](VertexId v) { return v < mesh_.inputVertices() ? notes_.shell_unit[v] : 0.0; };
  const Point &pa = mesh_.point(a), &pb = mesh_.point(b);
  double share = 0.5;
  if ((unit(a) > 0.0) != (unit(b) > 0.0)) {
    // On the shell round the small angle whose radius, the unit times a power of two, is nearest to the middle.
    const double length = distance(pa, pb);
    const double radius_unit = std::max(unit(a), unit(b));
    const double radius = radius_unit * std::exp2(std::round(std::log2(0.5 * length / radius_unit)));
    const double from = std::clamp(radius / length, 0.25, 0.75);
    share = unit(a) > 0.0 ? from : 1.0 - from;
  }
  const Point &sa = pslg_.points[pslg_.segments[seg].a], &sb = pslg_.points[pslg_.segments[seg].b];
  return projectedOnLine(pa + share * (pb - pa), sa, sb);
}

// Takes out the free vertices in the subsegment's diametral circle (Chew 1993). Returns the subsegment, which may have
// come to lie in another triangle.
EdgeRef Refiner::clearDiametralCircle(EdgeRef edge) {
  const VertexId a = mesh_.origin(edge), b = mesh_.target(edge);
  for (int side = 0; side < 2; ++side) {
    // Every round takes a vertex out.
    while (edge != kNone) {
      const VertexId v = mesh_.apex(edge);
      if (mesh_.kind(v) != VertexKind::Free ||
          dot(mesh_.point(a) - mesh_.point(v), mesh_.point(b) - mesh_.point(v)) >= 0.0)
        break;
      const VertexId from = mesh_.origin(edge);
      if (!removeFreeVertex(v)) break;
      ++stats_.removals;
      edge = kNone;
      for (const TriId t : touched_) {
        if (!mesh_.isLive(t)) continue;
        for (unsigned i = 0; i < 3; ++i)
          if (mesh_.segment(edgeRef(t, i)) != kNone && mesh_.origin(edgeRef(t, i)) == from &&
              mesh_.target(edgeRef(t, i)) == (from == a ? b : a))
            edge = edgeRef(t, i);
      }
    }
    if (side == 0 && edge != kNone && mesh_.twin(edge) != kNone) edge = mesh_.twin(edge);
  }
  return edge;
}

bool Refiner::splitFor(EdgeRef edge, TriId t, unsigned apex) {
  const SegmentId seg = mesh_.segment(edge);
  if (seg == kNone || seg == kFrozen) {
    if (seg == kFrozen && variant_.clear_of_frozen) defer(t);
    return false;
  }
  const VertexId a = mesh_.origin(edge), b = mesh_.target(edge);
  const VertexId fan = fanApexBehind(t, apex);
  if (fan != kNone && (a == fan || b == fan)) return false;
  const Point place = splitPlace(a, b, seg);
  if (stuck_.contains({a, b}) || !mesh_.findSplitCavity(edge, place, patch_)) return false;
  if (isBarred(patch_)) {
    defer(t);
    return false;
  }
  const double spacing = spacingOnSegment(place, edge, patch_);
  const double nearer = std::min(squaredDistance(place, mesh_.point(a)), squaredDistance(place, mesh_.point(b)));
  // Where the input itself is finer than coordinates resolve, nothing can be mended.
  if (std::min(nearer, spacing * spacing) < squared_resolution_) return false;
  if (nearer < kSegmentShare * kSegmentShare * spacing * spacing) return false;
  const EdgeRef cleared = clearDiametralCircle(edge);
  const VertexId v = cleared == kNone ? kNone : mesh_.splitSegment(cleared, place, touched_);
  if (v != kNone) {
    noteVertex(v, spacing);
    ++stats_.segment_splits;
    // The triangle that asked for the split may still be there, and bad.
    touched_.push_back(t);
  }
  if (v == kNone) {
    // Vertices may have gone for nothing, and would come back for as little.
    stuck_.insert({a, b});
    stuck_.insert({b, a});
  }
  std::ranges::sort(touched_);
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  enqueueTouched();
  return v != kNone;
}

}  // namespace coastmesh
