#include "core/vertex_ops.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// No vertex has more triangles round it than angles of the bound fit into a full turn.
std::size_t mostTriangles(const TriangleBound& bound) {
  if (bound.min_angle <= 0.0) return std::numeric_limits<std::size_t>::max() / 2;
  return static_cast<std::size_t>(2.0 * std::numbers::pi / bound.min_angle);
}
// Triangles that vanish when two vertices become one.
constexpr std::size_t kMergedAway = 2;

// The same for what is to be round a merged vertex, hardly ever so many that little is left.
bool hasTooManyToMerge(std::size_t triangles, const TriangleBound& bound) {
  constexpr double kMostTurn = toRadians(299.5);
  return static_cast<double>(triangles) * bound.min_angle > kMostTurn;
}

// One in a hundred merges is along an edge whose squared length is above this share of the mean round its end.
constexpr double kLongestToMerge = 1.6;

// Below this angle the mean of its neighbours, where that is feasible, is as good a place as the middle of all that is.
constexpr double kMeanServesBelow = toRadians(36.5);

VertexId otherEnd(const RimEdge& r, VertexId v) { return r.a == v ? r.b : r.a; }

Corners sorted(Corners corners) {
  std::ranges::sort(corners);
  return corners;
}

}  // namespace

VertexOps::VertexOps(EditMesh& mesh, const Pslg& pslg, const TriangleBound& bound)
    : mesh_(mesh),
      pslg_(pslg),
      bound_(bound),
      most_triangles_(mostTriangles(bound)),
      flips_may_harm_(bound.max_angle < std::numbers::pi || !std::isinf(bound.squared_size)) {}

// Fills inner_ (and outer_) with the subsegments at v, rim and link with what is round it, less what it shares with
// `other`. Answers false where there are too many triangles.
bool VertexOps::gather(VertexId v, VertexId other, VertexId stays) {
  const bool closed = mesh_.star(v, star_, most_triangles_ + kMergedAway);
  if (star_.size() > most_triangles_ + kMergedAway) return false;
  for (const EdgeRef e : star_) {
    const VertexId a = mesh_.origin(e), b = mesh_.target(e);
    const bool shared = a == other || b == other;
    if (!shared || v == stays) patch_.triangles.push_back(triOf(e));
    if (!shared) patch_.rim.push_back({a, b, mesh_.twin(e), mesh_.segment(e)});
    const EdgeRef spoke = spokeBefore(e);
    const SegmentId seg = mesh_.segment(spoke);
    if (a == other || seg == kNone) continue;
    inner_.push_back({stays, a, kNone, seg});
    if (mesh_.twin(spoke) == kNone) outer_.push_back(inner_.back());
  }
  if (closed) return true;
  const EdgeRef last = spokeAfter(star_.back());
  if (mesh_.origin(last) == other) return true;
  inner_.push_back({stays, mesh_.origin(last), kNone, mesh_.segment(last)});
  outer_.push_back({mesh_.origin(last), stays, kNone, mesh_.segment(last)});
  return true;
}

// Where v may go, with the link in patch_.rim and the subsegments at v in inner_.
std::optional<Point> VertexOps::findPlace(VertexId v) {
  link_.clear();
  for (const RimEdge& r : patch_.rim) link_.push_back({mesh_.point(r.a), mesh_.point(r.b)});
  if (mesh_.kind(v) == VertexKind::Free) return region_.findPoint(link_, bound_);
  if (inner_.size() != 2 || inner_[0].seg != inner_[1].seg || inner_[0].seg >= pslg_.segments.size())
    return std::nullopt;
  const std::optional<Point> place = FeasibleRegion::findPointBetween(
      mesh_.point(otherEnd(inner_[0], v)), mesh_.point(otherEnd(inner_[1], v)), link_, bound_);
  if (!place) return std::nullopt;
  // On the input segment itself, lest rounding adds up.
  const Segment& seg = pslg_.segments[inner_[0].seg];
  const Point &a = pslg_.points[seg.a], &b = pslg_.points[seg.b];
  return a + (dot(*place - a, b - a) / squaredDistance(a, b)) * (b - a);
}

bool VertexOps::fits(const Point& place) const {
  return std::ranges::all_of(
      link_, [&](const LinkEdge& e) { return orient2d(e.x, e.y, place) > 0 && !isBad(e.x, e.y, place, bound_); });
}

// Whether a fan round `place` over the rim would be flipped into triangles that no one has tested.
bool VertexOps::fanFlips(const Point& place) const {
  for (const RimEdge& r : patch_.rim) {
    const Point &a = mesh_.point(r.a), &b = mesh_.point(r.b);
    if (r.seg == kNone && r.beyond != kNone && inCircle(place, a, b, mesh_.point(mesh_.apex(r.beyond))) > 0)
      return true;
    const bool constrained =
        std::ranges::any_of(inner_, [&](const RimEdge& spoke) { return spoke.a == r.b || spoke.b == r.b; });
    const auto next = std::ranges::find_if(patch_.rim, [&](const RimEdge& s) { return s.a == r.b; });
    if (constrained || next == patch_.rim.end()) continue;
    if (inCircle(place, a, b, mesh_.point(next->b)) > 0) return true;
  }
  return false;
}

// The same for the triangles that are to fill a hole: they are Delaunay among themselves.
bool VertexOps::holeFlips() const {
  for (const Corners& c : all_fresh_) {
    for (const RimEdge& r : patch_.rim) {
      if (r.seg != kNone || r.beyond == kNone) continue;
      const bool on = (c[0] == r.a && c[1] == r.b) || (c[1] == r.a && c[2] == r.b) || (c[2] == r.a && c[0] == r.b);
      if (on &&
          inCircle(mesh_.point(c[0]), mesh_.point(c[1]), mesh_.point(c[2]), mesh_.point(mesh_.apex(r.beyond))) > 0)
        return true;
    }
  }
  return false;
}

// Whether the star in patch_ is next to a frozen edge, and is to be left alone for that.
bool VertexOps::isBarred() const {
  return clear_of_frozen_ && std::ranges::any_of(patch_.rim, [](const RimEdge& r) { return r.seg == kFrozen; });
}

bool VertexOps::isBadBeyond(EdgeRef e) const {
  if (e == kNone) return false;
  const TriId t = triOf(e);
  return isBad(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), bound_);
}

// Whether flips at the rim in patch_ could do harm.
bool VertexOps::mayNotFlip() const {
  return flips_may_harm_ ||
         (bad_stays_ && std::ranges::any_of(patch_.rim, [this](const RimEdge& r) { return isBadBeyond(r.beyond); }));
}

// The ring of a free vertex, from the triangle `home` on.
void VertexOps::walkRound(VertexId v, TriId home, Ring& ring) const {
  ring.corners.clear();
  ring.triangles.clear();
  TriId t = home;
  do {
    const Triangle& tri = mesh_.triangle(t);
    const unsigned i = mesh_.cornerOf(t, v);
    ring.corners.push_back(tri.v[next3(i)]);
    ring.triangles.push_back(t);
    t = triOf(tri.adj[next3(i)]);
  } while (t != home && ring.corners.size() <= most_triangles_ + kMergedAway);
}

// Appends to link_ what is round a vertex, less the edges that end at `other`.
void VertexOps::appendLink(const Ring& ring, VertexId other) {
  const std::size_t count = ring.corners.size();
  VertexId from = ring.corners[count - 1];
  Point x = mesh_.point(from);
  for (const VertexId to : ring.corners) {
    const Point y = mesh_.point(to);
    if (from != other && to != other) link_.push_back({x, y});
    from = to;
    x = y;
  }
}

// A quick test of two free vertices, v with its ring_ and w beside it, that rules most merges out.
bool VertexOps::cannotMerge(VertexId v, VertexId w, TriId beside) {
  walkRound(w, beside, other_ring_);
  const std::size_t edges = ring_.corners.size() + other_ring_.corners.size() - 4;
  if (edges < 3 || hasTooManyToMerge(edges, bound_)) return true;
  link_.clear();
  appendLink(ring_, w);
  appendLink(other_ring_, v);
  return region_.isEmpty(link_, bound_);
}

Point VertexOps::meanOfLink() const {
  Point sum;
  for (const LinkEdge& e : link_) sum = sum + e.x;
  return (1.0 / static_cast<double>(link_.size())) * sum;
}

bool VertexOps::relocateFree(VertexId v, std::vector<TriId>& touched) {
  walkRound(v, mesh_.triangleOf(v), ring_);
  if (ring_.corners.size() > most_triangles_) return false;
  link_.clear();
  appendLink(ring_, kNone);
  const Point& here = mesh_.point(v);
  const bool good = std::ranges::none_of(link_, [&](const LinkEdge& e) { return isBad(e.x, e.y, here, bound_); });
  if (!good && region_.isEmpty(link_, bound_)) return false;
  std::optional<Point> place;
  if (good && bound_.min_angle < kMeanServesBelow) place = meanOfLink();
  if (!place || !fits(*place)) place = region_.findPoint(link_, bound_);
  if (!place || !fits(*place)) return false;
  const auto isFrozen = [&](TriId t) { return mesh_.segment(edgeRef(t, mesh_.cornerOf(t, v))) == kFrozen; };
  if (clear_of_frozen_ && std::ranges::any_of(ring_.triangles, isFrozen)) return false;
  const auto isBesideBad = [&](TriId t) { return isBadBeyond(mesh_.twin(edgeRef(t, mesh_.cornerOf(t, v)))); };
  if (bad_stays_ && std::ranges::any_of(ring_.triangles, isBesideBad)) return relocateWatchingFlips(v, touched);
  mesh_.setPoint(v, *place);
  touched.insert(touched.end(), ring_.triangles.begin(), ring_.triangles.end());
  mesh_.restoreDelaunayRound(v, touched);
  return true;
}

bool VertexOps::relocate(VertexId v, std::vector<TriId>& touched) {
  if (mesh_.kind(v) == VertexKind::Free && !flips_may_harm_) return relocateFree(v, touched);
  return relocateWatchingFlips(v, touched);
}

bool VertexOps::relocateWatchingFlips(VertexId v, std::vector<TriId>& touched) {
  patch_.triangles.clear();
  patch_.rim.clear();
  inner_.clear();
  outer_.clear();
  if (!gather(v, kNone, v) || isBarred()) return false;
  const std::optional<Point> place = findPlace(v);
  if (!place || !fits(*place) || (mayNotFlip() && fanFlips(*place))) return false;
  mesh_.setPoint(v, *place);
  touched.insert(touched.end(), patch_.triangles.begin(), patch_.triangles.end());
  mesh_.restoreDelaunay(touched);
  return true;
}

// Triangulates the polygon of the rim edges first..last, closed by a straight edge where they are not closed
// themselves.
bool VertexOps::fillHole(std::size_t first, std::size_t last) {
  polygon_.clear();
  for (std::size_t i = first; i < last; ++i) polygon_.push_back(patch_.rim[i].a);
  if (patch_.rim[last - 1].b != polygon_.front()) polygon_.push_back(patch_.rim[last - 1].b);
  return polygon_.size() <= most_triangles_ && triangulateWell();
}

// Triangulates polygon_ into fresh_; answers false at the first triangle that is not taken.
bool VertexOps::triangulateWell() {
  return triangulatePolygon(mesh_, polygon_, fresh_, [this](const Corners& c) {
    return takes_any_ || !isBad(mesh_.point(c[0]), mesh_.point(c[1]), mesh_.point(c[2]), bound_) ||
           sorted(c) == excused_;
  });
}

bool VertexOps::removeInto(const Corners& excused, VertexId v, std::vector<TriId>& touched) {
  excused_ = sorted(excused);
  const bool gone = remove(v, touched);
  excused_ = {kNone, kNone, kNone};
  return gone;
}

bool VertexOps::removeAnyway(VertexId v, std::vector<TriId>& touched) {
  takes_any_ = true;
  const bool gone = remove(v, touched);
  takes_any_ = false;
  return gone;
}

bool VertexOps::remove(VertexId v, std::vector<TriId>& touched) {
  if (mesh_.kind(v) == VertexKind::Free) {
    // Most fail: before anything else is looked at.
    walkRound(v, mesh_.triangleOf(v), ring_);
    polygon_.assign(ring_.corners.begin(), ring_.corners.end());
    if (polygon_.size() > most_triangles_ || !triangulateWell()) return false;
  }
  const bool closed = mesh_.star(v, star_, most_triangles_);
  if (star_.size() > most_triangles_) return false;
  patch_.triangles.clear();
  patch_.rim.clear();
  inner_.clear();
  for (const EdgeRef e : star_) {
    patch_.triangles.push_back(triOf(e));
    patch_.rim.push_back({mesh_.origin(e), mesh_.target(e), mesh_.twin(e), mesh_.segment(e)});
  }
  if (isBarred()) return false;
  if (mesh_.kind(v) == VertexKind::Free) {
    all_fresh_ = fresh_;
  } else if (!closed) {
    // At the rim: the two subsegments become the last side of the hole.
    const SegmentId seg = mesh_.segment(spokeBefore(star_.front()));
    if (seg == kNone || mesh_.segment(spokeAfter(star_.back())) != seg || star_.size() < 2) return false;
    if (!fillHole(0, star_.size())) return false;
    all_fresh_ = fresh_;
    patch_.rim.push_back({patch_.rim.back().b, patch_.rim.front().a, kNone, seg});
  } else {
    // Inside the mesh: one hole on either side of the segment.
    const std::size_t count = star_.size();
    std::size_t first = count, second = count;
    for (std::size_t i = 0; i < count; ++i)
      if (mesh_.segment(spokeBefore(star_[i])) != kNone) (first == count ? first : second) = i;
    if (second == count || second - first < 2 || count - second + first < 2) return false;
    inner_.push_back({patch_.rim[first].a, patch_.rim[second].a, kNone, mesh_.segment(spokeBefore(star_[first]))});
    if (!fillHole(first, second)) return false;
    all_fresh_ = fresh_;
    std::ranges::rotate(patch_.rim, patch_.rim.begin() + static_cast<std::ptrdiff_t>(second));
    if (!fillHole(0, count - (second - first))) return false;
    all_fresh_.insert(all_fresh_.end(), fresh_.begin(), fresh_.end());
  }
  if (!takes_any_ && mayNotFlip() && holeFlips()) return false;
  mesh_.replace(patch_, all_fresh_, {&v, 1}, touched, inner_);
  mesh_.restoreDelaunay(touched);
  return true;
}

bool VertexOps::mergeWithNeighbour(VertexId v, bool each_gets_its_turn, std::vector<TriId>& touched) {
  if (mesh_.kind(v) == VertexKind::Free) {
    walkRound(v, mesh_.triangleOf(v), ring_);
    if (ring_.corners.size() > most_triangles_ + kMergedAway) return false;
    const Point here = mesh_.point(v);
    double longest = 0.0;
    for (const VertexId w : ring_.corners) longest += squaredDistance(here, mesh_.point(w));
    longest *= kLongestToMerge / static_cast<double>(ring_.corners.size());
    for (std::size_t k = 0; k < ring_.corners.size(); ++k) {
      const VertexId w = ring_.corners[k];
      const VertexKind kind = mesh_.kind(w);
      if (kind == VertexKind::Input) continue;
      if (kind == VertexKind::Free) {
        if (each_gets_its_turn && w < v) continue;
        if (squaredDistance(here, mesh_.point(w)) > longest || cannotMerge(v, w, ring_.triangles[k])) continue;
      }
      if (merge(v, w, touched)) return true;
    }
    return false;
  }
  mesh_.star(v, star_, most_triangles_ + kMergedAway);
  if (star_.size() > most_triangles_ + kMergedAway) return false;
  neighbours_.clear();
  for (const EdgeRef e : star_) neighbours_.push_back(mesh_.origin(e));
  if (const VertexId last = mesh_.target(star_.back()); last != neighbours_.front()) neighbours_.push_back(last);
  for (const VertexId w : neighbours_) {
    if (mesh_.kind(w) == VertexKind::Input || (each_gets_its_turn && w < v && mesh_.kind(w) == mesh_.kind(v))) continue;
    // The vertex that stays is the one on the segment.
    if (mesh_.kind(w) == VertexKind::Free ? merge(w, v, touched) : merge(v, w, touched)) return true;
  }
  return false;
}

bool VertexOps::merge(VertexId goes, VertexId stays, std::vector<TriId>& touched) {
  patch_.triangles.clear();
  patch_.rim.clear();
  inner_.clear();
  outer_.clear();
  if (!gather(goes, stays, stays)) return false;
  const std::size_t own = patch_.rim.size();
  if (!gather(stays, goes, stays) || isBarred()) return false;
  if (patch_.rim.size() < 3 || hasTooManyToMerge(patch_.rim.size(), bound_)) return false;
  // Link condition: the two stars share the corners beside their edge and no others.
  std::size_t common = 0;
  for (std::size_t i = own; i < patch_.rim.size(); ++i)
    for (std::size_t j = 0; j < own; ++j) common += patch_.rim[i].a == patch_.rim[j].b;
  if (common > 1) return false;
  const std::optional<Point> place = findPlace(stays);
  if (!place || !fits(*place) || (mayNotFlip() && fanFlips(*place))) return false;
  all_fresh_.clear();
  for (const RimEdge& r : patch_.rim) all_fresh_.push_back({stays, r.a, r.b});
  mesh_.setPoint(stays, *place);
  patch_.rim.insert(patch_.rim.end(), outer_.begin(), outer_.end());
  mesh_.replace(patch_, all_fresh_, {&goes, 1}, touched, inner_);
  mesh_.restoreDelaunay(touched);
  return true;
}

}  // namespace coastmesh
