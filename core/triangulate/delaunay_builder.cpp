#include "core/triangulate/delaunay_builder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <numeric>
#include <utility>

#include "core/flip.hpp"
#include "core/hilbert.hpp"
#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// The number of rounds after that of a point. Each round has four times the points of the previous one (Amenta, Choi,
// Rote, "Incremental constructions con BRIO", 2003; we differ: a hash replaces chance).
std::uint32_t roundsLeft(VertexId v) {
  std::uint32_t h = v * 0x9E3779B1u;
  h = (h ^ h >> 15) * 0x85EBCA77u;
  return static_cast<std::uint32_t>(std::countr_zero(h | 1u << 20)) / 2;
}

std::vector<VertexId> insertionOrder(const std::vector<VertexId>& along) {
  std::array<std::size_t, 12> first{};
  for (const VertexId v : along) ++first[11 - roundsLeft(v)];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<VertexId> order(along.size());
  for (const VertexId v : along) order[first[10 - roundsLeft(v)]++] = v;
  return order;
}

}  // namespace

DelaunayBuilder::DelaunayBuilder(std::span<const Point> points, const Surface& surface)
    : points_(points),
      along_curve_(hilbertOrder(points, surface)),
      ghost_(static_cast<VertexId>(points.size())),
      triangle_of_(points.size() + 1, kNone) {
  std::vector<VertexId> order = insertionOrder(along_curve_);
  if (!startWith(order)) return;
  for (std::size_t i = 3; i < order.size(); ++i) insertPoint(order[i]);
}

// Makes the first triangle, of the first three points not on a line; they move to the front. False if there are none.
bool DelaunayBuilder::startWith(std::vector<VertexId>& order) {
  if (order.size() < 2) return false;
  const Point &p = points_[order[0]], &q = points_[order[1]];
  if (p == q) throw Clash(Clash::Kind::PointsCoincide, order[1], kNone);
  const auto third =
      std::find_if(order.begin() + 2, order.end(), [&](VertexId v) { return orient2d(p, q, points_[v]) != 0; });
  if (third == order.end()) {
    std::ranges::sort(order, [&](VertexId a, VertexId b) { return lexLess(points_[a], points_[b]); });
    const auto same =
        std::ranges::adjacent_find(order, [&](VertexId a, VertexId b) { return points_[a] == points_[b]; });
    if (same != order.end()) throw Clash(Clash::Kind::PointsCoincide, *same, kNone);
    return false;
  }
  std::rotate(order.begin() + 2, third, third + 1);
  VertexId a = order[0], b = order[1];
  const VertexId c = order[2];
  if (orient2d(p, q, points_[c]) < 0) std::swap(a, b);
  mesh_.triangles.reserve(2 * points_.size());
  const TriId inner = makeTriangle(a, b, c);
  const TriId outer[3] = {makeTriangle(ghost_, c, b), makeTriangle(ghost_, a, c), makeTriangle(ghost_, b, a)};
  for (unsigned i = 0; i < 3; ++i) setTwins(mesh_.triangles, edgeRef(inner, i), edgeRef(outer[i], 0));
  for (unsigned i = 0; i < 3; ++i) setTwins(mesh_.triangles, edgeRef(outer[i], 1), edgeRef(outer[prev3(i)], 2));
  return true;
}

TriId DelaunayBuilder::makeTriangle(VertexId a, VertexId b, VertexId c) {
  const auto t = static_cast<TriId>(mesh_.triangles.size());
  mesh_.triangles.push_back(unlinked({a, b, c}));
  triangle_of_[a] = triangle_of_[b] = triangle_of_[c] = t;
  return t;
}

// True if inserting x removes the triangle: its circumcircle contains x. For a ghost: x is beyond its edge or on it.
bool DelaunayBuilder::isInConflict(TriId t, const Point& x) const {
  const auto& v = mesh_.triangles[t].v;
  if (!isGhost(t)) return inCircle(points_[v[0]], points_[v[1]], points_[v[2]], x) > 0;
  const unsigned i = mesh_.cornerOf(t, ghost_);
  const Point &a = points_[v[next3(i)]], &b = points_[v[prev3(i)]];
  const int side = orient2d(a, b, x);
  return side > 0 || (side == 0 && dot(a - x, b - x) < 0.0);
}

// Without segments the walk always ends; with them it may cycle: kNone after too many steps.
TriId DelaunayBuilder::walkTo(const Point& x, TriId from) const {
  TriId t = from;
  if (isGhost(t)) t = triOf(mesh_.triangles[t].adj[mesh_.cornerOf(t, ghost_)]);
  EdgeRef came = kNone;
  for (std::size_t steps = 0; steps <= mesh_.triangles.size(); ++steps) {
    EdgeRef onward = kNone;
    for (unsigned i = 0; i < 3 && onward == kNone; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (e != came && orient2d(points_[mesh_.origin(e)], points_[mesh_.target(e)], x) < 0) onward = e;
    }
    if (onward == kNone) return t;
    came = mesh_.twin(onward);
    t = triOf(came);
    if (isGhost(t)) return t;
  }
  return kNone;
}

TriId DelaunayBuilder::locate(const Point& x, TriId near) const {
  const TriId walked = walkTo(x, near);
  if (walked != kNone) return walked;
  TriId ghost = kNone;
  for (TriId t = 0; t < mesh_.triangles.size(); ++t) {
    const auto& v = mesh_.triangles[t].v;
    if (isGhost(t)) {
      ghost = t;
    } else if (orient2d(points_[v[0]], points_[v[1]], x) >= 0 && orient2d(points_[v[1]], points_[v[2]], x) >= 0 &&
               orient2d(points_[v[2]], points_[v[0]], x) >= 0) {
      return t;
    }
  }
  return ghost;
}

// Bowyer-Watson: a fan around the point replaces the triangles in conflict.
void DelaunayBuilder::insertPoint(VertexId v) {
  const Point x = points_[v];
  const TriId start = walkTo(x, static_cast<TriId>(mesh_.triangles.size() - 1));
  for (const VertexId corner : mesh_.triangles[start].v)
    if (corner != ghost_ && points_[corner] == x) throw Clash(Clash::Kind::PointsCoincide, v, kNone);
  cavity_.assign(1, start);
  cavity_edges_.clear();
  stack_.assign({edgeRef(start, 2), edgeRef(start, 1), edgeRef(start, 0)});
  while (!stack_.empty()) {
    const EdgeRef e = stack_.back();
    stack_.pop_back();
    const EdgeRef beyond = mesh_.twin(e);
    if (isInConflict(triOf(beyond), x)) {
      cavity_.push_back(triOf(beyond));
      stack_.push_back(edgeRef(triOf(beyond), prev3(indexOf(beyond))));
      stack_.push_back(edgeRef(triOf(beyond), next3(indexOf(beyond))));
    } else {
      cavity_edges_.push_back({mesh_.origin(e), mesh_.target(e), beyond});
    }
  }
  // The fan has two triangles more than the cavity. The next walk starts at the last one made.
  TriId last = kNone, first = kNone;
  for (std::size_t i = 0; i < cavity_edges_.size(); ++i) {
    const CavityEdge& r = cavity_edges_[i];
    TriId t;
    if (i < cavity_.size()) {
      t = cavity_[i];
      mesh_.triangles[t].v = {v, r.a, r.b};
      triangle_of_[r.a] = triangle_of_[r.b] = t;
    } else {
      t = makeTriangle(v, r.a, r.b);
    }
    setTwins(mesh_.triangles, edgeRef(t, 0), r.beyond);
    if (last == kNone) {
      first = t;
    } else {
      setTwins(mesh_.triangles, edgeRef(t, 2), edgeRef(last, 1));
    }
    last = t;
  }
  setTwins(mesh_.triangles, edgeRef(first, 2), edgeRef(last, 1));
  triangle_of_[v] = last;
}

// The edge from a to b; kNone if there is none.
EdgeRef DelaunayBuilder::findEdge(VertexId a, VertexId b) const {
  const TriId home = triangle_of_[a];
  TriId t = home;
  do {
    const unsigned i = mesh_.cornerOf(t, a);
    if (mesh_.triangles[t].v[next3(i)] == b) return edgeRef(t, prev3(i));
    t = triOf(mesh_.triangles[t].adj[next3(i)]);
  } while (t != home);
  return kNone;
}

// Collects the triangles between a and b in cavity_ and the edges beside them in sides_. Throws Clash if a segment or a
// vertex is in the way.
void DelaunayBuilder::openChannel(VertexId a, VertexId b) {
  const Point from = points_[a], to = points_[b];
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
  const TriId home = triangle_of_[a];
  TriId t = home;
  do {
    const unsigned i = mesh_.cornerOf(t, a);
    const VertexId right = mesh_.triangles[t].v[next3(i)], left = mesh_.triangles[t].v[prev3(i)];
    if (right != ghost_) {
      const int side = orient2d(from, to, points_[right]);
      if (side == 0 && dot(points_[right] - from, to - from) > 0.0)
        throw Clash(Clash::Kind::PointOnSegment, right, kNone);
      if (left != ghost_ && side < 0 && orient2d(from, to, points_[left]) > 0) e = edgeRef(t, i);
    }
    t = triOf(mesh_.triangles[t].adj[next3(i)]);
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
    const int side = v == b ? 0 : orient2d(from, to, points_[v]);
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
void DelaunayBuilder::attach(EdgeRef inside, unsigned side, std::size_t edge) {
  std::vector<SideEdge>& edges = sides_[side].edges;
  const SideEdge& beyond = edges[edge];
  if (beyond.partner == kNoPartner) {
    link(mesh_.triangles, inside, beyond.beyond, beyond.seg);
  } else {
    edges[beyond.partner].beyond = inside;
    edges[beyond.partner].partner = kNoPartner;
  }
}

// Triangulates the polygon between a side and the new segment. Every corner sees the segment, so Graham's scan suffices
// (Toussaint, Avis, "On a convex hull algorithm for polygons and its application to triangulation problems", 1982).
// Returns the edge along the segment.
EdgeRef DelaunayBuilder::fillSide(unsigned side) {
  const std::vector<VertexId>& corners = sides_[side].corners;
  scan_.assign(1, {corners[0], 0});
  for (std::size_t k = 1; k < corners.size(); ++k) {
    Scanned next{corners[k], k - 1};
    while (scan_.size() >= 2) {
      const VertexId p = scan_[scan_.size() - 2].v;
      const Scanned middle = scan_.back();
      const int turn = orient2d(points_[p], points_[middle.v], points_[next.v]);
      if (side == 0 ? turn >= 0 : turn <= 0) break;
      const TriId t = cavity_[filled_++];
      mesh_.triangles[t] = unlinked({p, side == 0 ? next.v : middle.v, side == 0 ? middle.v : next.v});
      for (const VertexId v : mesh_.triangles[t].v) triangle_of_[v] = t;
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

void DelaunayBuilder::insertSegment(VertexId a, VertexId b, SegmentId seg) {
  const EdgeRef there = findEdge(a, b);
  if (there != kNone) {
    if (mesh_.segment(there) != kNone) throw Clash(Clash::Kind::SegmentsCoincide, kNone, mesh_.segment(there));
    setSegment(mesh_.triangles, there, seg);
    return;
  }
  openChannel(a, b);
  const EdgeRef left = fillSide(0), right = fillSide(1);
  assert(filled_ == cavity_.size());
  link(mesh_.triangles, left, right, seg);
  stack_.clear();
  for (const TriId t : cavity_)
    for (unsigned i = 0; i < 3; ++i) stack_.push_back(edgeRef(t, i));
  restoreDelaunay();
}

// Lawson's flips, starting with the edges on the stack.
void DelaunayBuilder::restoreDelaunay() {
  flipWaiting(
      points_, mesh_.triangles, stack_,
      [this](EdgeRef e) { return mesh_.segment(e) == kNone && !isGhost(triOf(e)) && !isGhost(triOf(mesh_.twin(e))); },
      [this](TriId t, TriId n) {
        for (const TriId changed : {t, n})
          for (const VertexId v : mesh_.triangles[changed].v) triangle_of_[v] = changed;
      });
}

}  // namespace coastmesh
