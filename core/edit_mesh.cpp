#include "core/edit_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/flip.hpp"
#include "core/hilbert.hpp"
#include "core/links.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// Most triangles that are copied into their new order. That takes a third of the time; moving in place takes no memory,
// which matters for large meshes.
constexpr std::size_t kMostCopied = 2'000'000;

VertexId lastCorner(const Triangle& t) { return std::max({t.v[0], t.v[1], t.v[2]}); }

}  // namespace

EditMesh::EditMesh(TriMesh&& mesh, Unnoted)
    : LinkedTriangles{std::move(mesh.triangles)},
      points_(std::move(mesh.points)),
      kinds_(points_.size(), VertexKind::Free),
      triangle_of_(points_.size(), kNone),
      triangles_round_(points_.size(), 0),
      input_vertices_(mesh.input_vertices) {
  assert(findBrokenLink(triangles) == kNone);
  std::fill_n(kinds_.begin(), input_vertices_, VertexKind::Input);
}

EditMesh::EditMesh(TriMesh&& mesh) : EditMesh(std::move(mesh), Unnoted{}) {
  for (TriId t = 0; t < triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      triangle_of_[triangles[t].v[i]] = t;
      ++triangles_round_[triangles[t].v[i]];
      if (triangles[t].seg[i] == kNone) continue;
      for (const VertexId v : {origin(edgeRef(t, i)), target(edgeRef(t, i))})
        if (v >= input_vertices_) kinds_[v] = VertexKind::Segment;
    }
  }
}

// Of several triangles the last becomes a vertex's own, in whatever order threads come to them.
EditMesh::EditMesh(TriMesh&& mesh, const ItemLoop& loop) : EditMesh(std::move(mesh), Unnoted{}) {
  const auto keepLast = [](TriId& own, TriId t) {
    TriId before = __atomic_load_n(&own, __ATOMIC_RELAXED);
    while ((before == kNone || before < t) &&
           !__atomic_compare_exchange_n(&own, &before, t, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
    }
  };
  forEachByStretches(loop, triangles.size(), [&](std::size_t at) {
    const auto t = static_cast<TriId>(at);
    VertexKind on_segment = VertexKind::Segment;
    for (unsigned i = 0; i < 3; ++i) {
      keepLast(triangle_of_[triangles[t].v[i]], t);
      __atomic_fetch_add(&triangles_round_[triangles[t].v[i]], 1, __ATOMIC_RELAXED);
      if (triangles[t].seg[i] == kNone) continue;
      for (const VertexId v : {origin(edgeRef(t, i)), target(edgeRef(t, i))})
        if (v >= input_vertices_) __atomic_store(&kinds_[v], &on_segment, __ATOMIC_RELAXED);
    }
  });
}

// Numbers the vertices, and moves the points to their numbers.
void EditMesh::numberVertices(std::vector<VertexId>& number, bool along_curve) {
  number.assign(points_.size(), kNone);
  std::iota(number.begin(), number.begin() + input_vertices_, VertexId{0});
  if (!along_curve) {
    VertexId next = input_vertices_;
    for (VertexId v = input_vertices_; v < points_.size(); ++v) {
      if (!isLiveVertex(v)) continue;
      number[v] = next;
      points_[next++] = points_[v];
    }
    points_.resize(next);
    return;
  }
  // Neighbours in the plane are close in memory.
  const BulkList<VertexId> order = hilbertOrder(points_);
  std::vector<Point> steiner;
  steiner.reserve(points_.size() - input_vertices_);
  for (const VertexId v : order) {
    if (v < input_vertices_ || !isLiveVertex(v)) continue;
    number[v] = input_vertices_ + static_cast<VertexId>(steiner.size());
    steiner.push_back(points_[v]);
  }
  points_.resize(input_vertices_ + steiner.size());
  std::ranges::copy(steiner, points_.begin() + input_vertices_);
}

TriMesh EditMesh::released() {
  assert(findBrokenLink(triangles) == kNone);
  TriMesh mesh;
  mesh.input_vertices = input_vertices_;
  mesh.points = std::move(points_);
  mesh.triangles = std::move(triangles);
  return mesh;
}

TriMesh EditMesh::release(Renumbering& by, bool along_curve) {
  numberVertices(by.vertex, along_curve);
  // Triangles are ordered by their last vertex.
  std::vector<TriId> first(points_.size() + 1, 0);
  for (Triangle& t : triangles) {
    if (t.v[0] == kNone) continue;
    for (VertexId& v : t.v) v = by.vertex[v];
    ++first[lastCorner(t) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  const std::size_t count = first.back();
  std::vector<TriId>& slot = by.triangle;
  slot.assign(triangles.size(), kNone);
  for (TriId t = 0; t < triangles.size(); ++t)
    if (isLive(t)) slot[t] = first[lastCorner(triangles[t])]++;
  moveTriangles(slot, count);
  return released();
}

TriMesh EditMesh::releaseOn(const ItemLoop& loop, Renumbering& by) {
  numberVertices(by.vertex, false);
  std::vector<TriId> first(points_.size() + 1, 0);
  forEachByStretches(loop, triangles.size(), [&](std::size_t t) {
    if (triangles[t].v[0] == kNone) return;
    for (VertexId& v : triangles[t].v) v = by.vertex[v];
    __atomic_fetch_add(&first[lastCorner(triangles[t]) + 1], 1, __ATOMIC_RELAXED);
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  // Threads reach the triangles of a vertex in any order: they are sorted afterwards.
  std::vector<TriId> next(first.begin(), first.end() - 1), in_order;
  resizeAnew(loop, in_order, first.back());
  forEachByStretches(loop, triangles.size(), [&](std::size_t t) {
    if (triangles[t].v[0] == kNone) return;
    in_order[__atomic_fetch_add(&next[lastCorner(triangles[t])], 1, __ATOMIC_RELAXED)] = static_cast<TriId>(t);
  });
  by.triangle.assign(triangles.size(), kNone);
  forEachByStretches(loop, points_.size(), [&](std::size_t v) {
    std::sort(in_order.begin() + first[v], in_order.begin() + first[v + 1]);
    for (TriId slot = first[v]; slot < first[v + 1]; ++slot) by.triangle[in_order[slot]] = slot;
  });
  if (first.back() > kMostCopied) {
    moveTriangles(by.triangle, first.back());
    return released();
  }
  BulkList<Triangle> moved;
  resizeAnew(loop, moved, first.back());
  forEachByStretches(loop, moved.size(), [&](std::size_t slot) {
    moved[slot] = renumbered(
        triangles[in_order[slot]], [&](TriId t) { return by.triangle[t]; }, std::identity());
  });
  triangles = std::move(moved);
  return released();
}

// Moves every live triangle to its slot; there are `count` slots.
void EditMesh::moveTriangles(const std::vector<TriId>& slot, std::size_t count) {
  const auto linkedAnew = [&](const Triangle& t) {
    return renumbered(
        t, [&](TriId n) { return slot[n]; }, std::identity());
  };
  if (count <= kMostCopied) {
    BulkList<Triangle> in_order(count);
    for (TriId t = 0; t < triangles.size(); ++t)
      if (slot[t] != kNone) in_order[slot[t]] = linkedAnew(triangles[t]);
    triangles = std::move(in_order);
    return;
  }
  for (TriId t = 0; t < triangles.size(); ++t)
    if (slot[t] != kNone) triangles[t] = linkedAnew(triangles[t]);
  // Follows the permutation's cycles: the displaced triangle moves next.
  std::vector<bool> moved(triangles.size(), false);
  for (TriId start = 0; start < triangles.size(); ++start) {
    if (slot[start] == kNone || moved[start]) continue;
    Triangle carried = triangles[start];
    for (TriId from = start; from != kNone && !moved[from];) {
      moved[from] = true;
      const TriId to = slot[from];
      if (to != kNone) std::swap(carried, triangles[to]);
      from = to;
    }
  }
  triangles.resize(count);
}

bool EditMesh::ring(VertexId v, std::size_t most, Ring& ring) const {
  const std::size_t count = trianglesRound(v);
  if (count > most) return false;
  ring.corners.resize(count);
  ring.triangles.resize(count);
  VertexId* corner = ring.corners.data();
  TriId* triangle = ring.triangles.data();
  return walkRound(v, triangleOf(v), count, [&](EdgeRef e) {
           *corner++ = origin(e);
           *triangle++ = triOf(e);
         }) == StarKind::Closed;
}

StarKind EditMesh::star(VertexId v, std::vector<EdgeRef>& opposite, std::size_t most) const {
  opposite.clear();
  const TriId home = triangle_of_[v];
  const StarKind kind = walkRound(v, home, most, [&](EdgeRef e) { opposite.push_back(e); });
  if (kind != StarKind::Open) return kind;
  // The walk met the boundary: triangles clockwise of the first one come before it.
  const auto counter_clockwise = static_cast<std::ptrdiff_t>(opposite.size());
  for (EdgeRef before = triangles[home].adj[prev3(cornerOf(home, v))]; before != kNone;) {
    if (opposite.size() == most) return StarKind::TooMany;
    const TriId t = triOf(before);
    const unsigned i = cornerOf(t, v);
    opposite.push_back(edgeRef(t, i));
    before = triangles[t].adj[prev3(i)];
  }
  std::reverse(opposite.begin() + counter_clockwise, opposite.end());
  std::rotate(opposite.begin(), opposite.begin() + counter_clockwise, opposite.end());
  return StarKind::Open;
}

bool EditMesh::gatherPatch(std::span<const VertexId> vertices, Patch& patch) const {
  patch.triangles.clear();
  patch.boundary.clear();
  const auto isGone = [&](VertexId v) { return std::ranges::find(vertices, v) != vertices.end(); };
  for (const VertexId v : vertices) {
    const auto gather = [&](EdgeRef opposite) {
      const TriId t = triOf(opposite);
      const bool known = vertices.size() > 1 && std::ranges::find(patch.triangles, t) != patch.triangles.end();
      if (!known) patch.triangles.push_back(t);
      if (!isGone(origin(opposite)) && !isGone(target(opposite)))
        patch.boundary.push_back({origin(opposite), target(opposite), twin(opposite), segment(opposite)});
    };
    if (walkRound(v, triangle_of_[v], kNone, gather) != StarKind::Closed) return false;
  }
  if (vertices.size() == 1) return true;
  // Fails at an edge with patch triangles on both sides, which three vertices in a ring can have; chains the others.
  for (std::size_t i = 0; i < patch.boundary.size(); ++i) {
    if (patch.boundary[i].beyond != kNone &&
        std::ranges::find(patch.triangles, triOf(patch.boundary[i].beyond)) != patch.triangles.end())
      return false;
    if (i + 1 == patch.boundary.size()) break;
    const auto follower = std::find_if(patch.boundary.begin() + i + 1, patch.boundary.end(),
                                       [&](const BoundaryEdge& r) { return r.a == patch.boundary[i].b; });
    if (follower == patch.boundary.end()) return false;
    std::iter_swap(patch.boundary.begin() + i + 1, follower);
  }
  if (patch.boundary.empty() || patch.boundary.back().b != patch.boundary.front().a) return false;
  // By Euler's formula, a patch with more triangles contains a vertex that is not among those given.
  if (patch.triangles.size() != patch.boundary.size() + 2 * vertices.size() - 2) return false;
  // A vertex that the loop passes twice pinches the patch.
  for (std::size_t i = 0; i < patch.boundary.size(); ++i)
    for (std::size_t j = i + 1; j < patch.boundary.size(); ++j)
      if (patch.boundary[i].a == patch.boundary[j].a) return false;
  return true;
}

EditMesh::Place EditMesh::locate(const Point& x, TriId from) const {
  TriId t = from;
  EdgeRef came = kNone;
  for (TriId steps = 0; steps <= triangleSlots(); ++steps) {
    EdgeRef onward = kNone, blocked = kNone;
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (e == came || orient2d(points_[origin(e)], points_[target(e)], x) >= 0) continue;
      if (isConstrained(e)) {
        blocked = e;
      } else {
        onward = e;
        break;
      }
    }
    if (onward != kNone) {
      came = twin(onward);
      t = triOf(came);
    } else if (blocked != kNone) {
      return {kNone, blocked};
    } else {
      return {t, kNone};
    }
  }
  return {};
}

// Visits the triangles beyond the edges on the stack, depth first, so that the boundary is found in order.
void EditMesh::collectConflicts(const Point& x, std::span<const EdgeRef> across, Patch& cavity) const {
  stack_.assign(across.rbegin(), across.rend());
  while (!stack_.empty()) {
    const EdgeRef e = stack_.back();
    stack_.pop_back();
    const EdgeRef beyond = twin(e);
    if (!isConstrained(e)) {
      const TriId n = triOf(beyond);
      const Triangle& other = triangles[n];
      if (inCircle(points_[other.v[0]], points_[other.v[1]], points_[other.v[2]], x) > 0) {
        cavity.triangles.push_back(n);
        stack_.push_back(edgeRef(n, prev3(indexOf(beyond))));
        stack_.push_back(edgeRef(n, next3(indexOf(beyond))));
        continue;
      }
    }
    cavity.boundary.push_back({origin(e), target(e), beyond, segment(e)});
  }
}

bool EditMesh::findCavity(const Point& x, TriId start, Patch& cavity) const {
  cavity.triangles.assign(1, start);
  cavity.boundary.clear();
  const EdgeRef all[3] = {edgeRef(start, 0), edgeRef(start, 1), edgeRef(start, 2)};
  collectConflicts(x, all, cavity);
  return std::ranges::all_of(cavity.boundary,
                             [&](const BoundaryEdge& r) { return orient2d(points_[r.a], points_[r.b], x) > 0; });
}

// Appends one side of the cavity of a point on a subsegment. Returns false if rounding has moved the point outside the
// circumcircle of a flat triangle: the side is then that triangle alone, and the fan needs flips.
bool EditMesh::appendSide(EdgeRef side, const Point& x, Patch& cavity) const {
  const TriId t = triOf(side);
  const EdgeRef others[2] = {edgeRef(t, next3(indexOf(side))), edgeRef(t, prev3(indexOf(side)))};
  cavity.triangles.push_back(t);
  const Corners& c = triangles[t].v;
  const bool in_circle = inCircle(points_[c[0]], points_[c[1]], points_[c[2]], x) > 0;
  if (in_circle) {
    collectConflicts(x, others, cavity);
  } else {
    for (const EdgeRef e : others) cavity.boundary.push_back({origin(e), target(e), twin(e), segment(e)});
  }
  return in_circle;
}

bool EditMesh::findSplitCavity(EdgeRef edge, const Point& x, Patch& cavity) const {
  cavity.triangles.clear();
  cavity.boundary.clear();
  for (const EdgeRef side : {edge, twin(edge)})
    if (side != kNone) appendSide(side, x, cavity);
  return std::ranges::all_of(cavity.boundary,
                             [&](const BoundaryEdge& r) { return orient2d(points_[r.a], points_[r.b], x) > 0; });
}

TriId EditMesh::newTriangle() {
  if (free_triangles_.empty()) {
    triangles.emplace_back();
    return static_cast<TriId>(triangles.size() - 1);
  }
  const TriId t = free_triangles_.back();
  free_triangles_.pop_back();
  return t;
}

VertexId EditMesh::addVertex(const Point& x, VertexKind kind) {
  VertexId v;
  if (free_vertices_.empty()) {
    v = static_cast<VertexId>(points_.size());
    points_.push_back(x);
    kinds_.push_back(kind);
    triangle_of_.push_back(kNone);
    triangles_round_.push_back(0);
  } else {
    v = free_vertices_.back();
    free_vertices_.pop_back();
    points_[v] = x;
    kinds_[v] = kind;
  }
  return v;
}

void EditMesh::kill(TriId t) {
  triangles[t].v[0] = kNone;
  free_triangles_.push_back(t);
}

void EditMesh::noteCorners(TriId t) {
  const Corners& corners = triangles[t].v;
  assert(corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]);
  for (const VertexId v : corners) {
    triangle_of_[v] = t;
    ++triangles_round_[v];
  }
}

// To be called before a live triangle gets other corners or none.
void EditMesh::forgetCorners(TriId t) {
  for (const VertexId v : triangles[t].v) --triangles_round_[v];
}

// Makes triangles (x, a, b) on the boundary edges a -> b, linked to the triangles beyond and to one another, but not
// the first to the last.
void EditMesh::fillFan(VertexId x, const Patch& cavity, std::vector<TriId>& fan) {
  fan.clear();
  for (const TriId t : cavity.triangles) forgetCorners(t);
  for (std::size_t i = 0; i < cavity.boundary.size(); ++i)
    fan.push_back(i < cavity.triangles.size() ? cavity.triangles[i] : newTriangle());
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const BoundaryEdge& r = cavity.boundary[i];
    triangles[fan[i]].v = {x, r.a, r.b};
    noteCorners(fan[i]);
    link(triangles, edgeRef(fan[i], 0), r.beyond, r.seg);
    if (i > 0) link(triangles, edgeRef(fan[i], 2), edgeRef(fan[i - 1], 1), kNone);
  }
}

VertexId EditMesh::insertInCavity(const Point& x, const Patch& cavity, std::vector<TriId>& touched) {
  const VertexId v = addVertex(x, VertexKind::Free);
  fillFan(v, cavity, fan_[0]);
  link(triangles, edgeRef(fan_[0].front(), 2), edgeRef(fan_[0].back(), 1), kNone);
  touched.insert(touched.end(), fan_[0].begin(), fan_[0].end());
  return v;
}

VertexId EditMesh::splitSegment(EdgeRef edge, const Point& x, std::vector<TriId>& touched) {
  const SegmentId seg = segment(edge);
  const EdgeRef sides[2] = {edge, twin(edge)};
  bool in_circles = true;
  for (int s = 0; s < 2; ++s) {
    side_[s].triangles.clear();
    side_[s].boundary.clear();
    if (sides[s] == kNone) continue;
    in_circles &= appendSide(sides[s], x, side_[s]);
    for (const BoundaryEdge& r : side_[s].boundary)
      if (orient2d(points_[r.a], points_[r.b], x) <= 0) return kNone;
  }
  const VertexId v = addVertex(x, VertexKind::Segment);
  for (int s = 0; s < 2; ++s) {
    if (sides[s] == kNone) continue;
    fillFan(v, side_[s], fan_[s]);
    touched.insert(touched.end(), fan_[s].begin(), fan_[s].end());
  }
  const bool two_sided = sides[1] != kNone;
  link(triangles, edgeRef(fan_[0].front(), 2), two_sided ? edgeRef(fan_[1].back(), 1) : kNone, seg);
  link(triangles, edgeRef(fan_[0].back(), 1), two_sided ? edgeRef(fan_[1].front(), 2) : kNone, seg);
  if (!in_circles) restoreDelaunay(touched);
  return v;
}

void EditMesh::replace(const Patch& patch, std::span<const Corners> fresh, std::span<const VertexId> gone,
                       std::vector<TriId>& touched, std::span<const BoundaryEdge> inner) {
  std::vector<TriId>& slots = fan_[0];
  slots.clear();
  for (const TriId t : patch.triangles) forgetCorners(t);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    slots.push_back(i < patch.triangles.size() ? patch.triangles[i] : newTriangle());
    triangles[slots[i]] = unlinked(fresh[i]);
    noteCorners(slots[i]);
  }
  for (std::size_t i = fresh.size(); i < patch.triangles.size(); ++i) kill(patch.triangles[i]);
  // Each edge finds its other side either on the boundary or among the fresh edges that are still unlinked.
  std::vector<EdgeRef>& waiting = stack_;
  waiting.clear();
  for (const TriId t : slots) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      const VertexId a = origin(e), b = target(e);
      const auto boundary =
          std::ranges::find_if(patch.boundary, [&](const BoundaryEdge& r) { return r.a == a && r.b == b; });
      if (boundary != patch.boundary.end()) {
        link(triangles, e, boundary->beyond, boundary->seg);
        continue;
      }
      const auto other = std::ranges::find_if(waiting, [&](EdgeRef f) { return origin(f) == b && target(f) == a; });
      if (other == waiting.end()) {
        waiting.push_back(e);
        continue;
      }
      const auto constraint = std::ranges::find_if(
          inner, [&](const BoundaryEdge& r) { return (r.a == a && r.b == b) || (r.a == b && r.b == a); });
      link(triangles, e, *other, constraint == inner.end() ? kNone : constraint->seg);
      *other = waiting.back();
      waiting.pop_back();
    }
  }
  assert(waiting.empty());
  for (const VertexId v : gone) {
    triangle_of_[v] = kNone;
    free_vertices_.push_back(v);
  }
  touched.insert(touched.end(), slots.begin(), slots.end());
}

void EditMesh::restoreDelaunay(std::vector<TriId>& touched) {
  stack_.clear();
  for (const TriId t : touched) {
    if (!isLive(t)) continue;
    for (unsigned i = 0; i < 3; ++i) stack_.push_back(edgeRef(t, i));
  }
  flipStack(touched);
}

void EditMesh::restoreDelaunayRound(VertexId v, std::vector<TriId>& touched, bool spokes_are) {
  stack_.clear();
  for (const TriId t : touched) {
    const unsigned i = cornerOf(t, v);
    stack_.push_back(edgeRef(t, i));
    if (!spokes_are) stack_.push_back(edgeRef(t, next3(i)));
  }
  flipStack(touched);
}

void EditMesh::flipStack(std::vector<TriId>& touched) {
  flipWaiting(
      points_, triangles, stack_, [this](EdgeRef e) { return !isConstrained(e); },
      [&](TriId t, TriId n) {
        const VertexId a = triangles[t].v[0], b = triangles[t].v[1], d = triangles[t].v[2], c = triangles[n].v[2];
        triangle_of_[a] = triangle_of_[d] = triangle_of_[c] = n;
        triangle_of_[b] = t;
        ++triangles_round_[a];
        ++triangles_round_[d];
        --triangles_round_[b];
        --triangles_round_[c];
        touched.push_back(t);
        touched.push_back(n);
      });
}

std::size_t detail::delaunayApex(const EditMesh& mesh, std::span<const VertexId> chain) {
  const Point a = mesh.point(chain.front()), b = mesh.point(chain.back());
  std::size_t best = 0;
  for (std::size_t k = 1; k + 1 < chain.size(); ++k) {
    const Point& c = mesh.point(chain[k]);
    if (orient2d(a, c, b) <= 0) continue;
    if (best == 0 || inCircle(a, mesh.point(chain[best]), b, c) > 0) best = k;
  }
  return best;
}

}  // namespace coastmesh
