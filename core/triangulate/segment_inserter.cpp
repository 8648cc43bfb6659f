#include "core/triangulate/segment_inserter.hpp"

#include <algorithm>
#include <cassert>

#include "core/flip.hpp"
#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

EdgeRef SegmentInserter::findEdge(VertexId a, VertexId b) const {
  const TriId home = all_.triangle_of[a];
  TriId t = home;
  do {
    const unsigned i = mesh_.cornerOf(t, a);
    if (triangles_[t].v[next3(i)] == b) return edgeRef(t, prev3(i));
    t = triOf(triangles_[t].adj[next3(i)]);
  } while (t != home);
  return kNone;
}

// Collects the triangles between a and b in cavity_ and the edges beside them in sides_. Throws Clash if a segment or a
// vertex is in the way.
void SegmentInserter::openChannel(VertexId a, VertexId b) {
  const Point from = all_.points[a], to = all_.points[b];
  cavity_.clear();
  for (Side& side : sides_) {
    side.corners.assign(1, a);
    side.edges.clear();
  }
  const auto extend = [&](unsigned side, VertexId v, EdgeRef inside) {
    sides_[side].corners.push_back(v);
    sides_[side].edges.push_back({inside, mesh_.twin(inside), mesh_.segment(inside), kNoPartner});
  };
  // Finds the triangle at a that the segment leaves, through the edge e from right to left.
  EdgeRef e = kNone;
  const TriId home = all_.triangle_of[a];
  TriId t = home;
  do {
    const unsigned i = mesh_.cornerOf(t, a);
    const VertexId right = triangles_[t].v[next3(i)], left = triangles_[t].v[prev3(i)];
    if (right != all_.ghost) {
      const int side = orient2d(from, to, all_.points[right]);
      if (side == 0 && dot(all_.points[right] - from, to - from) > 0.0)
        throw Clash(Clash::Kind::PointOnSegment, right, kNone);
      if (left != all_.ghost && side < 0 && orient2d(from, to, all_.points[left]) > 0) e = edgeRef(t, i);
    }
    t = triOf(triangles_[t].adj[next3(i)]);
  } while (t != home);
  assert(e != kNone);
  cavity_.push_back(triOf(e));
  extend(0, mesh_.target(e), edgeRef(triOf(e), next3(indexOf(e))));
  extend(1, mesh_.origin(e), edgeRef(triOf(e), prev3(indexOf(e))));
  for (VertexId v = kNone; v != b;) {
    if (mesh_.segment(e) != kNone) throw Clash(Clash::Kind::SegmentsCross, kNone, mesh_.segment(e));
    const EdgeRef beyond = mesh_.twin(e);
    const EdgeRef on_left = edgeRef(triOf(beyond), prev3(indexOf(beyond)));
    const EdgeRef on_right = edgeRef(triOf(beyond), next3(indexOf(beyond)));
    cavity_.push_back(triOf(beyond));
    v = mesh_.apex(beyond);
    const int side = v == b ? 0 : orient2d(from, to, all_.points[v]);
    if (v != b && side == 0) throw Clash(Clash::Kind::PointOnSegment, v, kNone);
    if (side >= 0) extend(0, v, on_left);
    if (side <= 0) extend(1, v, on_right);
    e = side > 0 ? on_right : on_left;
  }
  // An edge that dangles into the cavity has both its sides inside.
  std::vector<TriId> inside = cavity_;
  std::ranges::sort(inside);
  for (Side& side : sides_) {
    for (SideEdge& edge : side.edges) {
      if (!std::ranges::binary_search(inside, triOf(edge.beyond))) continue;
      const auto partner = std::ranges::find(side.edges, edge.beyond, &SideEdge::inside);
      assert(partner != side.edges.end());
      edge.partner = static_cast<std::size_t>(partner - side.edges.begin());
    }
  }
  filled_ = 0;
}

// Links an edge of a new triangle to what is beyond, or leaves that to its partner.
void SegmentInserter::attach(EdgeRef inside, unsigned side, std::size_t edge) {
  std::vector<SideEdge>& edges = sides_[side].edges;
  const SideEdge& beyond = edges[edge];
  if (beyond.partner == kNoPartner) {
    link(triangles_, inside, beyond.beyond, beyond.seg);
  } else {
    edges[beyond.partner].beyond = inside;
    edges[beyond.partner].partner = kNoPartner;
  }
}

// Triangulates the polygon between a side and the new segment. Every corner sees the segment, so Graham's scan suffices
// (Toussaint, Avis, "On a convex hull algorithm for polygons and its application to triangulation problems", 1982).
// Returns the edge along the segment.
EdgeRef SegmentInserter::fillSide(unsigned side) {
  const std::vector<VertexId>& corners = sides_[side].corners;
  scan_.assign(1, {corners[0], 0});
  for (std::size_t k = 1; k < corners.size(); ++k) {
    Scanned next{corners[k], k - 1};
    while (scan_.size() >= 2) {
      const VertexId p = scan_[scan_.size() - 2].v;
      const Scanned middle = scan_.back();
      const int turn = orient2d(all_.points[p], all_.points[middle.v], all_.points[next.v]);
      if (side == 0 ? turn >= 0 : turn <= 0) break;
      const TriId t = cavity_[filled_++];
      triangles_[t] = unlinked({p, side == 0 ? next.v : middle.v, side == 0 ? middle.v : next.v});
      for (const VertexId v : triangles_[t].v) all_.triangle_of[v] = t;
      attach(edgeRef(t, 0), side, next.edge);
      attach(edgeRef(t, side == 0 ? 1 : 2), side, middle.edge);
      const EdgeRef inner = edgeRef(t, side == 0 ? 2 : 1);
      next.edge = sides_[side].edges.size();
      sides_[side].edges.push_back({kNone, inner, kNone, kNoPartner});
      scan_.pop_back();
    }
    scan_.push_back(next);
  }
  assert(scan_.size() == 2);
  return sides_[side].edges[scan_.back().edge].beyond;
}

void SegmentInserter::mark(EdgeRef edge, SegmentId seg) {
  if (mesh_.segment(edge) != kNone) throw Clash(Clash::Kind::SegmentsCoincide, kNone, mesh_.segment(edge));
  setSegment(triangles_, edge, seg);
}

void SegmentInserter::insert(VertexId a, VertexId b, SegmentId seg) {
  if (const EdgeRef there = findEdge(a, b); there != kNone) {
    mark(there, seg);
    return;
  }
  openChannel(a, b);
  const EdgeRef left = fillSide(0), right = fillSide(1);
  assert(filled_ == cavity_.size());
  link(triangles_, left, right, seg);
  stack_.clear();
  for (const TriId t : cavity_)
    for (unsigned i = 0; i < 3; ++i) stack_.push_back(edgeRef(t, i));
  restoreDelaunay();
}

// Lawson's flips, starting with the edges on the stack.
void SegmentInserter::restoreDelaunay() {
  flipWaiting(
      all_.points, triangles_, stack_,
      [this](EdgeRef e) {
        return mesh_.segment(e) == kNone && !all_.isGhost(triOf(e)) && !all_.isGhost(triOf(mesh_.twin(e)));
      },
      [this](TriId t, TriId n) {
        for (const TriId changed : {t, n})
          for (const VertexId v : triangles_[changed].v) all_.triangle_of[v] = changed;
      });
}

}  // namespace coastmesh
