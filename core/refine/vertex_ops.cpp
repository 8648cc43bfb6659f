#include "core/refine/vertex_ops.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// No vertex has more good triangles than minimum angles fit into a full turn.
std::size_t mostTriangles(const TriangleBound& bound) {
  if (bound.min_angle <= 0.0) return std::numeric_limits<std::size_t>::max() / 2;
  return static_cast<std::size_t>(2.0 * std::numbers::pi / bound.min_angle);
}
// Triangles that vanish when two vertices merge.
constexpr std::size_t kMergedAway = 2;

// The same for a merged vertex. The limit is below a full turn: close to that a place is hardly ever feasible.
std::size_t mostTrianglesMerged(const TriangleBound& bound) {
  constexpr double kMostTurn = toRadians(299.5);
  if (bound.min_angle <= 0.0) return std::numeric_limits<std::size_t>::max() / 2;
  return static_cast<std::size_t>(kMostTurn / bound.min_angle);
}

// Merges are tried along edges whose squared length, as a share of the mean around their end, is in this range. Along
// longer ones one in a hundred succeeds; beside bad triangles, along shorter ones 15 of 55,000 did.
struct Lengths {
  double least, most;
};
constexpr Lengths kAllButLong{0.0, 1.6}, kBesideBad{0.4, 1.2};

// Below this minimum angle the mean of the neighbours, if feasible, is as good a target as the middle of the region.
constexpr double kMeanServesBelow = toRadians(36.5);

// The cotangent of the angle up to which a good triangle stays Delaunay beside any good one, less a margin for
// rounding: the largest possible angle there is a half turn less two of the smallest.
double cotOfSafeAngle(const TriangleBound& bound) {
  if (bound.min_angle <= 0.0) return std::numeric_limits<double>::infinity();
  return 1.0 / std::tan(2.0 * bound.min_angle) + 1e-6;
}

// Moves to try for a good vertex, as shares of the way to its target: beyond it first, since its neighbours move too
// (over-relaxation), and half of it if no more is feasible.
constexpr double kShares[] = {1.6, 1.0, 0.5};

VertexId otherEnd(const BoundaryEdge& r, VertexId v) { return r.a == v ? r.b : r.a; }

Corners sorted(Corners corners) {
  std::ranges::sort(corners);
  return corners;
}

using Link = std::vector<LinkEdge>;

// Sets `link` to the edges of a ring.
void takeLink(const EditMesh& mesh, const Ring& ring, Link& link) {
  const std::size_t count = ring.corners.size();
  link.resize(count);
  Point x = mesh.point(ring.corners[count - 1]);
  for (std::size_t k = 0; k < count; ++k) {
    const Point y = mesh.point(ring.corners[k]);
    link[k] = {x, y};
    x = y;
  }
}

// Calls `visit` with the edge opposite v in each triangle around it, counter-clockwise from the triangle `home`, while
// it returns true. Returns whether that completed a turn, in `most` triangles or fewer.
template <typename Visit>
bool walkAllRound(const EditMesh& mesh, VertexId v, TriId home, std::size_t most, const Visit& visit) {
  TriId t = home;
  for (std::size_t left = most; left > 0; --left) {
    const unsigned i = mesh.cornerOf(t, v);
    if (!visit(edgeRef(t, i))) return false;
    const EdgeRef after = mesh.twin(edgeRef(t, next3(i)));
    if (after == kNone) return false;
    t = triOf(after);
    if (t == home) return true;
  }
  return false;
}

bool fits(std::span<const LinkEdge> link, const Point& place, const TriangleBound& bound) {
  return std::ranges::all_of(
      link, [&](const LinkEdge& e) { return orient2d(e.x, e.y, place) > 0 && !isBad(e.x, e.y, place, bound); });
}

// The mean of the corners of a ring.
Point meanOf(const LookEdges& edges) {
  Point sum;
  for (std::size_t i = 0; i < edges.size(); ++i) sum = sum + edges[i].from;
  return (1.0 / static_cast<double>(edges.size())) * sum;
}

}  // namespace

VertexOps::VertexOps(EditMesh& mesh, const Pslg& pslg, const TriangleBound& bound)
    : mesh_(mesh),
      pslg_(pslg),
      bound_(bound),
      most_triangles_(mostTriangles(bound)),
      most_merged_(mostTrianglesMerged(bound)),
      cot_safe_(cotOfSafeAngle(bound)),
      flips_may_harm_(bound.max_angle < std::numbers::pi || !std::isinf(bound.squared_size)),
      region_(bound) {}

void VertexOps::keepBadInPlace() {
  bad_stays_ = true;
  if (bound_.surface.isCurved()) return;
  at_bad_.assign(mesh_.vertexSlots(), 0);
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t) {
    if (!mesh_.isLive(t) || !isBad(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), bound_)) continue;
    for (const VertexId v : mesh_.triangle(t).v) at_bad_[v] = 1;
  }
}

void VertexOps::Star::clear() {
  patch.triangles.clear();
  patch.boundary.clear();
  spokes.clear();
  sides.clear();
}

// Appends the star of v, except what it shares with `other`; its spokes start at `stays`. Returns false if there are
// too many triangles.
bool VertexOps::appendStar(VertexId v, VertexId other, VertexId stays, Star& star) {
  std::vector<EdgeRef>& opposite = memory_.opposite;
  const StarKind kind = mesh_.star(v, opposite, most_triangles_ + kMergedAway);
  if (kind == StarKind::TooMany) return false;
  for (const EdgeRef e : opposite) {
    const VertexId a = mesh_.origin(e), b = mesh_.target(e);
    const bool shared = a == other || b == other;
    if (!shared || v == stays) star.patch.triangles.push_back(triOf(e));
    if (!shared) star.patch.boundary.push_back({a, b, mesh_.twin(e), mesh_.segment(e)});
    const EdgeRef spoke = spokeBefore(e);
    const SegmentId seg = mesh_.segment(spoke);
    if (a == other || seg == kNone) continue;
    star.spokes.push_back({stays, a, kNone, seg});
    if (mesh_.twin(spoke) == kNone) star.sides.push_back(star.spokes.back());
  }
  if (kind == StarKind::Closed) return true;
  const EdgeRef last = spokeAfter(opposite.back());
  if (mesh_.origin(last) == other) return true;
  star.spokes.push_back({stays, mesh_.origin(last), kNone, mesh_.segment(last)});
  star.sides.push_back({mesh_.origin(last), stays, kNone, mesh_.segment(last)});
  return true;
}

bool VertexOps::gather(VertexId v, Star& star) {
  star.clear();
  return appendStar(v, kNone, v, star);
}

// Gathers the star of two neighbours. Returns false if they cannot become one: by the link condition the two stars
// share the corners beside their edge and no others.
bool VertexOps::gatherBoth(VertexId goes, VertexId stays, Star& star) {
  star.clear();
  if (!appendStar(goes, stays, stays, star)) return false;
  const std::size_t own = star.patch.boundary.size();
  if (!appendStar(stays, goes, stays, star) || isBarred(star)) return false;
  const std::vector<BoundaryEdge>& boundary = star.patch.boundary;
  if (boundary.size() < 3 || boundary.size() > most_merged_) return false;
  std::size_t common = 0;
  for (std::size_t i = own; i < boundary.size(); ++i)
    for (std::size_t j = 0; j < own; ++j) common += boundary[i].a == boundary[j].b;
  return common <= 1;
}

// A link in a frame.
std::span<const LinkEdge> VertexOps::framed(const Frame& frame, std::span<const LinkEdge> link) {
  if (!frame.isCurved()) return link;
  Link& seen = memory_.framed_link;
  seen.assign(link.begin(), link.end());
  for (LinkEdge& e : seen) e = {frame.to(e.x), frame.to(e.y)};
  return seen;
}

// A place for v where all triangles of its star are good; nullopt if none.
std::optional<Point> VertexOps::findPlace(VertexId v, const Star& star) {
  Link& link = memory_.link;
  link.clear();
  for (const BoundaryEdge& r : star.patch.boundary) link.push_back({mesh_.point(r.a), mesh_.point(r.b)});
  const std::optional<Point> place = findFeasible(v, star, link);
  if (!place || !fits(link, *place, bound_)) return std::nullopt;
  return place;
}

std::optional<Point> VertexOps::findFeasible(VertexId v, const Star& star, std::span<const LinkEdge> link) {
  const Frame frame(bound_.surface, mesh_.point(v));
  const auto inPlane = [&](std::optional<Point> place) {
    if (place) place = frame.from(*place);
    return place;
  };
  if (mesh_.kind(v) == VertexKind::Free) return inPlane(region_.findPoint(framed(frame, link)));
  if (star.spokes.size() != 2 || star.spokes[0].seg != star.spokes[1].seg ||
      star.spokes[0].seg >= pslg_.segments.size())
    return std::nullopt;
  const std::optional<Point> place =
      inPlane(region_.findPointBetween(frame.to(mesh_.point(otherEnd(star.spokes[0], v))),
                                       frame.to(mesh_.point(otherEnd(star.spokes[1], v))), framed(frame, link)));
  if (!place) return std::nullopt;
  // On the input segment itself, so that rounding errors do not add up.
  const Segment& seg = pslg_.segments[star.spokes[0].seg];
  return projectedOnLine(*place, pslg_.points[seg.a], pslg_.points[seg.b]);
}

// True if flips would change a fan around `place` into triangles that were not tested.
bool VertexOps::fanFlips(const Star& star, const Point& place) const {
  for (const BoundaryEdge& r : star.patch.boundary) {
    const Point &a = mesh_.point(r.a), &b = mesh_.point(r.b);
    if (r.seg == kNone && r.beyond != kNone && inCircle(place, a, b, mesh_.point(mesh_.apex(r.beyond))) > 0)
      return true;
    const bool constrained =
        std::ranges::any_of(star.spokes, [&](const BoundaryEdge& spoke) { return spoke.a == r.b || spoke.b == r.b; });
    const auto next = std::ranges::find_if(star.patch.boundary, [&](const BoundaryEdge& s) { return s.a == r.b; });
    if (constrained || next == star.patch.boundary.end()) continue;
    if (inCircle(place, a, b, mesh_.point(next->b)) > 0) return true;
  }
  return false;
}

// The same for the triangles that fill a hole, which are Delaunay among themselves.
bool VertexOps::holeFlips(const Star& star, std::span<const Corners> fresh) const {
  for (const Corners& c : fresh) {
    for (const BoundaryEdge& r : star.patch.boundary) {
      if (r.seg != kNone || r.beyond == kNone) continue;
      const bool on = (c[0] == r.a && c[1] == r.b) || (c[1] == r.a && c[2] == r.b) || (c[2] == r.a && c[0] == r.b);
      if (on &&
          inCircle(mesh_.point(c[0]), mesh_.point(c[1]), mesh_.point(c[2]), mesh_.point(mesh_.apex(r.beyond))) > 0)
        return true;
    }
  }
  return false;
}

// True if a star is next to a frozen edge, and must therefore be skipped.
bool VertexOps::isBarred(const Star& star) const {
  return clear_of_frozen_ &&
         std::ranges::any_of(star.patch.boundary, [](const BoundaryEdge& r) { return r.seg == kFrozen; });
}

bool VertexOps::isBadBeyond(EdgeRef e) const {
  if (e == kNone) return false;
  const TriId t = triOf(e);
  return isBad(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), bound_);
}

// True if flips at the boundary of a star could do harm.
bool VertexOps::mayNotFlip(const Star& star) const {
  return flips_may_harm_ || (bad_stays_ && std::ranges::any_of(star.patch.boundary, [this](const BoundaryEdge& r) {
                               return !isClearOfBad(r.a) && !isClearOfBad(r.b) && isBadBeyond(r.beyond);
                             }));
}

// True if two neighbours would have too many triangles as one vertex: at most four of their sum are shared or vanish.
bool VertexOps::hasTooManyTogether(VertexId v, VertexId w) const {
  return mesh_.trianglesRound(v) + mesh_.trianglesRound(w) > most_merged_ + 4;
}

// The ring of a free vertex; null if it has more triangles than `most`.
const Ring* VertexOps::gatherRing(VertexId v, std::size_t most) {
  memory_.ring_look.forget();
  Ring& ring = memory_.ring;
  return mesh_.ring(v, most, ring) ? &ring : nullptr;
}

// A quick test of two free vertices, v with its prepared ring and the one at its corner k, that rules out most merges:
// mostly by the box alone, before all of the other star is visited.
bool VertexOps::cannotMerge(const Frame& frame, VertexId v, const Ring& ring, std::size_t k) {
  PetalBox box = memory_.ring_look.boxWithout(k);
  if (box.isEmpty()) return true;
  LookEdges& edges = memory_.look_edges;
  edges.clear();
  LookEdge edge;
  const auto append = [&](EdgeRef e) {
    const VertexId a = mesh_.origin(e), b = mesh_.target(e);
    if (a == v || b == v) return true;
    box.cut(region_.ready(frame.to(mesh_.point(a)), frame.to(mesh_.point(b)), edge));
    edges.push(edge);
    return !box.isEmpty();
  };
  if (!walkAllRound(mesh_, ring.corners[k], ring.triangles[k], most_triangles_ + kMergedAway, append)) return true;
  memory_.ring_look.visitWithout(k, [&](const LookEdge& e) {
    edges.push(e);
    return true;
  });
  return region_.look(edges, box).is_empty;
}

// The neighbours along its segment of a vertex there, from a triangle at it; nullopt if there are too many triangles
// between them.
std::optional<std::pair<VertexId, VertexId>> VertexOps::alongSegment(VertexId w, TriId between) const {
  const auto walk = [&](unsigned (*side)(unsigned)) {
    TriId t = between;
    for (std::size_t left = most_triangles_ + kMergedAway; left > 0; --left) {
      const unsigned i = mesh_.cornerOf(t, w);
      const EdgeRef spoke = edgeRef(t, side(i));
      if (mesh_.isConstrained(spoke)) return mesh_.triangle(t).v[3 - i - side(i)];
      t = triOf(mesh_.twin(spoke));
    }
    return VertexId{kNone};
  };
  const VertexId before = walk(prev3), after = walk(next3);
  if (before == kNone || after == kNone) return std::nullopt;
  return std::pair(before, after);
}

// The same for a corner on a segment, where the merged vertex stays on it: by the star of v alone.
bool VertexOps::cannotMergeOnto(const Frame& frame, const Ring& ring, std::size_t k) const {
  const PetalBox box = memory_.ring_look.boxWithout(k);
  if (box.isEmpty()) return true;
  const auto ends = alongSegment(ring.corners[k], ring.triangles[k]);
  if (!ends) return true;
  const Point a = frame.to(mesh_.point(ends->first)), b = frame.to(mesh_.point(ends->second));
  PetalBox both{{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
  both.cut(box);
  if (both.low.x > both.high.x || both.low.y > both.high.y) return true;
  LinePart part(a, b);
  return !memory_.ring_look.visitWithout(k, [&](const LookEdge& e) { return region_.cut(part, {e.from, e.to}); });
}

// Like `fits` if only smallest angles are bounded; in the plane it leaves the triangles in `fan`.
bool VertexOps::fitsAt(const Point& place, const Frame& frame, const Ring& ring) {
  if (!frame.isCurved()) return memory_.fan.fit(memory_.ring_look.edges(mesh_, frame, ring), place, bound_);
  takeLink(mesh_, ring, memory_.link);
  return fits(memory_.link, place, bound_);
}

// A feasible place on the way to `to`, which is in the vertex's frame; nullopt if none.
std::optional<Point> VertexOps::placeTowards(const Point& to, const Frame& frame, const Point& here, const Ring& ring) {
  const Point from = frame.to(here);
  for (const double share : kShares) {
    const Point place = frame.from(from + share * (to - from));
    if (fitsAt(place, frame, ring)) return place;
  }
  return std::nullopt;
}

// True if a bad triangle lies beyond the ring of a vertex.
bool VertexOps::isBesideBad(VertexId v, const Ring& ring) const {
  return std::ranges::any_of(ring.triangles,
                             [&](TriId t) { return isBadBeyond(mesh_.twin(edgeRef(t, mesh_.cornerOf(t, v)))); });
}

// True if an edge of a free vertex's star may not be Delaunay, with the vertex at the place last passed to `fitsAt`.
// `all_clear`: of bad triangles. Plane only.
bool VertexOps::needsFlips(VertexId v, const Ring& ring, bool all_clear) {
  constexpr double kClear = 1e-6;
  Fan& fan = memory_.fan;
  if (!fan.spokesAreDelaunay()) return true;
  const std::size_t count = ring.corners.size();
  const Point& here = mesh_.point(v);
  // Edge k leads to corner k; its triangle is the one before the triangle at that corner.
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = k == 0 ? count - 1 : k - 1;
    const Fan::Triangle t = fan[k];
    const bool is_safe = t.at_place > cot_safe_ * t.area;
    if (is_safe && (all_clear || isClearOfBad(ring.corners[at]) || isClearOfBad(ring.corners[k]))) continue;
    const EdgeRef e = edgeRef(ring.triangles[at], mesh_.cornerOf(ring.triangles[at], v));
    if (mesh_.isConstrained(e)) continue;
    const Point &x = mesh_.point(ring.corners[at]), &y = mesh_.point(ring.corners[k]);
    const Point& beyond = mesh_.point(mesh_.apex(mesh_.twin(e)));
    // Usually the two angles opposite the edge clearly add up to less than a half turn.
    const Point to_x = x - beyond, to_y = y - beyond;
    const double area = cross(to_y, to_x), scale = t.area * area;
    if (t.at_place * area + dot(to_x, to_y) * t.area > kClear * scale && scale > 0.0) continue;
    if (inCircle(here, x, y, beyond) > 0) return true;
  }
  return false;
}

bool VertexOps::relocateFree(VertexId v, const Ring& ring, std::vector<TriId>& touched) {
  const Point here = mesh_.point(v);
  const Frame frame(bound_.surface, here);
  LookEdges& edges = memory_.ring_look.edges(mesh_, frame, ring);
  const bool good = isClearOfBad(v) || fitsAt(here, frame, ring);
  const auto isFrozen = [&](TriId t) { return mesh_.segment(edgeRef(t, mesh_.cornerOf(t, v))) == kFrozen; };
  if (clear_of_frozen_ && std::ranges::any_of(ring.triangles, isFrozen)) return false;
  std::optional<Point> place;
  if (good && bound_.min_angle < kMeanServesBelow) place = placeTowards(meanOf(edges), frame, here, ring);
  if (!place) {
    if (bound_.min_angle <= 0.0) return false;
    const std::optional<Point> inside = region_.look(edges, memory_.ring_look.box(region_)).point;
    if (!inside) return false;
    if (good)
      place = placeTowards(*inside, frame, here, ring);
    else if (const Point there = frame.from(*inside); fitsAt(there, frame, ring))
      place = there;
  }
  if (!place) return false;
  const bool all_clear = std::ranges::all_of(ring.corners, [&](VertexId w) { return isClearOfBad(w); });
  if (bad_stays_ && !all_clear && isBesideBad(v, ring)) return relocateWatchingFlips(v, touched);
  mesh_.setPoint(v, *place);
  touched.insert(touched.end(), ring.triangles.begin(), ring.triangles.end());
  if (bound_.surface.isCurved() || needsFlips(v, ring, all_clear)) mesh_.restoreDelaunayRound(v, touched);
  return true;
}

bool VertexOps::relocate(VertexId v, std::vector<TriId>& touched) {
  if (mesh_.kind(v) != VertexKind::Free || flips_may_harm_) return relocateWatchingFlips(v, touched);
  const Ring* ring = gatherRing(v, most_triangles_);
  return ring != nullptr && relocateFree(v, *ring, touched);
}

bool VertexOps::relocateWatchingFlips(VertexId v, std::vector<TriId>& touched) {
  Star& star = memory_.star;
  if (!gather(v, star) || isBarred(star)) return false;
  const std::optional<Point> place = findPlace(v, star);
  if (!place || (mayNotFlip(star) && fanFlips(star, *place))) return false;
  mesh_.setPoint(v, *place);
  touched.insert(touched.end(), star.patch.triangles.begin(), star.patch.triangles.end());
  mesh_.restoreDelaunay(touched);
  return true;
}

bool VertexOps::isGood(const Corners& c) const {
  return !isBad(mesh_.point(c[0]), mesh_.point(c[1]), mesh_.point(c[2]), bound_);
}

// Triangulates the polygon of some boundary edges, closed by a straight edge if they are not a loop. Returns false at
// the first triangle that `accept` rejects.
template <typename Accept>
bool VertexOps::fillHole(std::span<const BoundaryEdge> side, const Accept& accept, std::vector<Corners>& fresh) {
  std::vector<VertexId>& polygon = memory_.polygon;
  polygon.clear();
  for (const BoundaryEdge& r : side) polygon.push_back(r.a);
  if (side.back().b != polygon.front()) polygon.push_back(side.back().b);
  return polygon.size() <= most_triangles_ && triangulatePolygon(mesh_, polygon, fresh, accept);
}

// Fills the hole that a vertex on a segment leaves, whose two subsegments become one: `star` has the boundary of its
// triangles and receives the one subsegment. Returns false if that is impossible.
template <typename Accept>
bool VertexOps::fillBesideSegment(std::span<const EdgeRef> opposite, StarKind kind, const Accept& accept, Star& star,
                                  std::vector<Corners>& fresh) {
  std::vector<BoundaryEdge>& boundary = star.patch.boundary;
  if (kind == StarKind::Open) {
    // On the boundary: the two subsegments become the last side of the hole.
    const SegmentId seg = mesh_.segment(spokeBefore(opposite.front()));
    if (seg == kNone || mesh_.segment(spokeAfter(opposite.back())) != seg || boundary.size() < 2) return false;
    if (!fillHole(boundary, accept, fresh)) return false;
    boundary.push_back({boundary.back().b, boundary.front().a, kNone, seg});
    return true;
  }
  // Inside the mesh: one hole on either side of the segment.
  const auto isOnSegment = [&](EdgeRef e) { return mesh_.segment(spokeBefore(e)) != kNone; };
  const auto one = std::ranges::find_if(opposite, isOnSegment);
  if (one == opposite.end()) return false;
  const auto other = std::find_if(one + 1, opposite.end(), isOnSegment);
  if (other == opposite.end()) return false;
  const auto first = static_cast<std::size_t>(one - opposite.begin());
  const auto beside = static_cast<std::size_t>(other - one);
  if (beside < 2 || boundary.size() - beside < 2) return false;
  std::ranges::rotate(boundary, boundary.begin() + static_cast<std::ptrdiff_t>(first));
  star.spokes.push_back({boundary[0].a, boundary[beside].a, kNone, mesh_.segment(spokeBefore(*one))});
  std::vector<Corners>& beyond = memory_.fresh_beyond;
  if (!fillHole(std::span(boundary).first(beside), accept, fresh)) return false;
  if (!fillHole(std::span(boundary).subspan(beside), accept, beyond)) return false;
  fresh.insert(fresh.end(), beyond.begin(), beyond.end());
  return true;
}

bool VertexOps::remove(VertexId v, std::vector<TriId>& touched) {
  return removeWhere(
      v, Flips::Watched, [this](const Corners& c) { return isGood(c); }, touched);
}

bool VertexOps::removeInto(const Corners& excused, VertexId v, std::vector<TriId>& touched) {
  const auto accept = [&, only = sorted(excused)](const Corners& c) { return isGood(c) || sorted(c) == only; };
  return removeWhere(v, Flips::Watched, accept, touched);
}

bool VertexOps::removeAnyway(VertexId v, std::vector<TriId>& touched) {
  return removeWhere(
      v, Flips::Any, [](const Corners&) { return true; }, touched);
}

template <typename Accept>
bool VertexOps::removeWhere(VertexId v, Flips flips, const Accept& accept, std::vector<TriId>& touched) {
  if (mesh_.kind(v) == VertexKind::Free) {
    // Most attempts fail here, before anything else is examined.
    if (!mesh_.ring(v, most_triangles_, memory_.ring)) return false;
    if (!triangulatePolygon(mesh_, memory_.ring.corners, memory_.fresh, accept)) return false;
  }
  return takeOut(v, flips, accept, touched);
}

// REQUIRES: for a free vertex, `fresh` has the triangles that replace it.
template <typename Accept>
bool VertexOps::takeOut(VertexId v, Flips flips, const Accept& accept, std::vector<TriId>& touched) {
  std::vector<Corners>& fresh = memory_.fresh;
  std::vector<EdgeRef>& opposite = memory_.opposite;
  const StarKind kind = mesh_.star(v, opposite, most_triangles_);
  if (kind == StarKind::TooMany) return false;
  Star& star = memory_.star;
  star.clear();
  std::vector<BoundaryEdge>& boundary = star.patch.boundary;
  for (const EdgeRef e : opposite) {
    star.patch.triangles.push_back(triOf(e));
    boundary.push_back({mesh_.origin(e), mesh_.target(e), mesh_.twin(e), mesh_.segment(e)});
  }
  if (isBarred(star)) return false;
  if (mesh_.kind(v) != VertexKind::Free && !fillBesideSegment(opposite, kind, accept, star, fresh)) return false;
  if (flips == Flips::Watched && mayNotFlip(star) && holeFlips(star, fresh)) return false;
  mesh_.replace(star.patch, fresh, {&v, 1}, touched, star.spokes);
  mesh_.restoreDelaunay(touched);
  return true;
}

bool VertexOps::mergeFree(VertexId v, const Ring& ring, bool each_gets_its_turn, std::vector<TriId>& touched) {
  const Point here = mesh_.point(v);
  const Frame frame(bound_.surface, here);
  const Lengths& tried = each_gets_its_turn ? kAllButLong : kBesideBad;
  double mean = 0.0;                         // squared length of the spokes, computed when first needed
  const bool asks = bound_.min_angle > 0.0;  // otherwise no quick test applies
  for (std::size_t k = 0; k < ring.corners.size(); ++k) {
    const VertexId w = ring.corners[k];
    const VertexKind kind = mesh_.kind(w);
    if (kind == VertexKind::Input || hasTooManyTogether(v, w)) continue;
    if (kind == VertexKind::Free) {
      if (each_gets_its_turn && w < v) continue;
      if (mean == 0.0) {
        for (const VertexId u : ring.corners) mean += bound_.surface.squaredChord(here, mesh_.point(u));
        mean /= static_cast<double>(ring.corners.size());
      }
      const double squared = bound_.surface.squaredChord(here, mesh_.point(w));
      if (squared < tried.least * mean || squared > tried.most * mean) continue;
    }
    if (asks) {
      memory_.ring_look.edges(mesh_, frame, ring);
      memory_.ring_look.prepareBoxes(region_);
      if (kind == VertexKind::Free ? cannotMerge(frame, v, ring, k) : cannotMergeOnto(frame, ring, k)) continue;
    }
    if (merge(v, w, touched)) return true;
  }
  return false;
}

bool VertexOps::mergeWithNeighbour(VertexId v, bool each_gets_its_turn, std::vector<TriId>& touched) {
  if (mesh_.kind(v) == VertexKind::Free) {
    const Ring* ring = gatherRing(v, most_triangles_ + kMergedAway);
    return ring != nullptr && mergeFree(v, *ring, each_gets_its_turn, touched);
  }
  std::vector<EdgeRef>& opposite = memory_.opposite;
  if (mesh_.star(v, opposite, most_triangles_ + kMergedAway) == StarKind::TooMany) return false;
  // Along its segment only: of 16,630 free vertices tried beside those on segments 3 could be merged into them.
  std::vector<VertexId>& neighbours = memory_.neighbours;
  neighbours.clear();
  for (const EdgeRef e : opposite)
    if (mesh_.isConstrained(spokeBefore(e))) neighbours.push_back(mesh_.origin(e));
  if (mesh_.twin(spokeAfter(opposite.back())) == kNone) neighbours.push_back(mesh_.target(opposite.back()));
  for (const VertexId w : neighbours) {
    if (mesh_.kind(w) == VertexKind::Input || (each_gets_its_turn && w < v) || hasTooManyTogether(v, w)) continue;
    if (merge(v, w, touched)) return true;
  }
  return false;
}

VertexOps::Change VertexOps::tryInTurn(VertexId v, const Tries& tries, std::vector<TriId>& touched) {
  const bool removes = mesh_.trianglesRound(v) <= tries.removes_up_to;
  if (mesh_.kind(v) != VertexKind::Free || flips_may_harm_) {
    if (removes && remove(v, touched)) return Change::Removed;
    if (tries.merges && mergeWithNeighbour(v, true, touched)) return Change::Merged;
    return tries.moves && relocate(v, touched) ? Change::Moved : Change::None;
  }
  const Ring* around = gatherRing(v, most_triangles_ + kMergedAway);
  if (around == nullptr) return Change::None;
  const Ring& ring = *around;
  const auto accept = [this](const Corners& c) { return isGood(c); };
  const bool few = ring.corners.size() <= most_triangles_;
  if (removes && few && triangulatePolygon(mesh_, ring.corners, memory_.fresh, accept) &&
      takeOut(v, Flips::Watched, accept, touched))
    return Change::Removed;
  if (tries.merges && mergeFree(v, ring, true, touched)) return Change::Merged;
  return tries.moves && few && relocateFree(v, ring, touched) ? Change::Moved : Change::None;
}

bool VertexOps::merge(VertexId goes, VertexId stays, std::vector<TriId>& touched) {
  Star& star = memory_.star;
  if (!gatherBoth(goes, stays, star)) return false;
  const std::optional<Point> place = findPlace(stays, star);
  if (!place || (mayNotFlip(star) && fanFlips(star, *place))) return false;
  std::vector<Corners>& fresh = memory_.fresh;
  fresh.clear();
  for (const BoundaryEdge& r : star.patch.boundary) fresh.push_back({stays, r.a, r.b});
  mesh_.setPoint(stays, *place);
  star.patch.boundary.insert(star.patch.boundary.end(), star.sides.begin(), star.sides.end());
  mesh_.replace(star.patch, fresh, {&goes, 1}, touched, star.spokes);
  mesh_.restoreDelaunay(touched);
  return true;
}

}  // namespace coastmesh
