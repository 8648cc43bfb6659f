#include "core/refine/vertex_ops.hpp"

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

// The same for what is to be round a merged vertex. The limit is below a full turn: near that a place is hardly ever
// feasible.
bool hasTooManyToMerge(std::size_t triangles, const TriangleBound& bound) {
  constexpr double kMostTurn = toRadians(299.5);
  return static_cast<double>(triangles) * bound.min_angle > kMostTurn;
}

// One in a hundred merges is along an edge whose squared length is above this share of the mean round its end.
constexpr double kLongestToMerge = 1.6;

// Below this angle the mean of its neighbours, where that is feasible, is as good a place as the middle of all that is.
constexpr double kMeanServesBelow = toRadians(36.5);

VertexId otherEnd(const BoundaryEdge& r, VertexId v) { return r.a == v ? r.b : r.a; }

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
      flips_may_harm_(bound.max_angle < std::numbers::pi || !std::isinf(bound.squared_size)),
      region_(bound) {}

void VertexOps::Star::clear() {
  patch.triangles.clear();
  patch.boundary.clear();
  spokes.clear();
  sides.clear();
}

// Appends what is round v, less what it shares with `other`; its spokes start at `stays`. Returns false where there are
// too many triangles.
bool VertexOps::appendStar(VertexId v, VertexId other, VertexId stays, Star& star) {
  const StarKind kind = mesh_.star(v, opposite_, most_triangles_ + kMergedAway);
  if (kind == StarKind::TooMany) return false;
  for (const EdgeRef e : opposite_) {
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
  const EdgeRef last = spokeAfter(opposite_.back());
  if (mesh_.origin(last) == other) return true;
  star.spokes.push_back({stays, mesh_.origin(last), kNone, mesh_.segment(last)});
  star.sides.push_back({mesh_.origin(last), stays, kNone, mesh_.segment(last)});
  return true;
}

bool VertexOps::gather(VertexId v, Star& star) {
  star.clear();
  return appendStar(v, kNone, v, star);
}

// What is round two neighbours. Returns false where they cannot become one: the link condition, that the two stars
// share the corners beside their edge and no others.
bool VertexOps::gatherBoth(VertexId goes, VertexId stays, Star& star) {
  star.clear();
  if (!appendStar(goes, stays, stays, star)) return false;
  const std::size_t own = star.patch.boundary.size();
  if (!appendStar(stays, goes, stays, star) || isBarred(star)) return false;
  const std::vector<BoundaryEdge>& boundary = star.patch.boundary;
  if (boundary.size() < 3 || hasTooManyToMerge(boundary.size(), bound_)) return false;
  std::size_t common = 0;
  for (std::size_t i = own; i < boundary.size(); ++i)
    for (std::size_t j = 0; j < own; ++j) common += boundary[i].a == boundary[j].b;
  return common <= 1;
}

// Where v may go; fills link_.
std::optional<Point> VertexOps::findPlace(VertexId v, const Star& star) {
  link_.clear();
  for (const BoundaryEdge& r : star.patch.boundary) link_.push_back({mesh_.point(r.a), mesh_.point(r.b)});
  if (mesh_.kind(v) == VertexKind::Free) return region_.findPoint(link_);
  if (star.spokes.size() != 2 || star.spokes[0].seg != star.spokes[1].seg ||
      star.spokes[0].seg >= pslg_.segments.size())
    return std::nullopt;
  const std::optional<Point> place = region_.findPointBetween(mesh_.point(otherEnd(star.spokes[0], v)),
                                                              mesh_.point(otherEnd(star.spokes[1], v)), link_);
  if (!place) return std::nullopt;
  // On the input segment itself, lest rounding adds up.
  const Segment& seg = pslg_.segments[star.spokes[0].seg];
  return projectedOnLine(*place, pslg_.points[seg.a], pslg_.points[seg.b]);
}

bool VertexOps::fits(const Point& place) const {
  return std::ranges::all_of(
      link_, [&](const LinkEdge& e) { return orient2d(e.x, e.y, place) > 0 && !isBad(e.x, e.y, place, bound_); });
}

// Whether a fan round `place` over the boundary would be flipped into triangles that no one has tested.
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

// The same for the triangles that are to fill a hole: they are Delaunay among themselves.
bool VertexOps::holeFlips(const Star& star) const {
  for (const Corners& c : all_fresh_) {
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

// Whether a star is next to a frozen edge, and is to be left alone for that.
bool VertexOps::isBarred(const Star& star) const {
  return clear_of_frozen_ &&
         std::ranges::any_of(star.patch.boundary, [](const BoundaryEdge& r) { return r.seg == kFrozen; });
}

bool VertexOps::isBadBeyond(EdgeRef e) const {
  if (e == kNone) return false;
  const TriId t = triOf(e);
  return isBad(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), bound_);
}

// Whether flips at the boundary of a star could do harm.
bool VertexOps::mayNotFlip(const Star& star) const {
  return flips_may_harm_ || (bad_stays_ && std::ranges::any_of(star.patch.boundary, [this](const BoundaryEdge& r) {
                               return isBadBeyond(r.beyond);
                             }));
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
  if (mesh_.ring(w, beside, most_triangles_ + kMergedAway, other_ring_) != StarKind::Closed) return true;
  const std::size_t edges = ring_.corners.size() + other_ring_.corners.size() - 4;
  if (edges < 3 || hasTooManyToMerge(edges, bound_)) return true;
  link_.clear();
  appendLink(ring_, w);
  appendLink(other_ring_, v);
  return region_.isEmpty(link_);
}

Point VertexOps::meanOfLink() const {
  Point sum;
  for (const LinkEdge& e : link_) sum = sum + e.x;
  return (1.0 / static_cast<double>(link_.size())) * sum;
}

bool VertexOps::relocateFree(VertexId v, std::vector<TriId>& touched) {
  if (mesh_.ring(v, mesh_.triangleOf(v), most_triangles_, ring_) != StarKind::Closed) return false;
  link_.clear();
  appendLink(ring_, kNone);
  const Point& here = mesh_.point(v);
  const bool good = std::ranges::none_of(link_, [&](const LinkEdge& e) { return isBad(e.x, e.y, here, bound_); });
  if (!good && region_.isEmpty(link_)) return false;
  std::optional<Point> place;
  if (good && bound_.min_angle < kMeanServesBelow) place = meanOfLink();
  if (!place || !fits(*place)) place = region_.findPoint(link_);
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
  if (!gather(v, star_) || isBarred(star_)) return false;
  const std::optional<Point> place = findPlace(v, star_);
  if (!place || !fits(*place) || (mayNotFlip(star_) && fanFlips(star_, *place))) return false;
  mesh_.setPoint(v, *place);
  touched.insert(touched.end(), star_.patch.triangles.begin(), star_.patch.triangles.end());
  mesh_.restoreDelaunay(touched);
  return true;
}

bool VertexOps::isGood(const Corners& c) const {
  return !isBad(mesh_.point(c[0]), mesh_.point(c[1]), mesh_.point(c[2]), bound_);
}

// Triangulates the polygon of some boundary edges, closed by a straight edge where they are not closed themselves, into
// fresh_. Returns false at the first triangle that `accept` refuses.
template <typename Accept>
bool VertexOps::fillHole(std::span<const BoundaryEdge> side, const Accept& accept) {
  polygon_.clear();
  for (const BoundaryEdge& r : side) polygon_.push_back(r.a);
  if (side.back().b != polygon_.front()) polygon_.push_back(side.back().b);
  return polygon_.size() <= most_triangles_ && triangulatePolygon(mesh_, polygon_, fresh_, accept);
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
    // Most fail: before anything else is looked at.
    if (mesh_.ring(v, mesh_.triangleOf(v), most_triangles_, ring_) != StarKind::Closed) return false;
    if (!triangulatePolygon(mesh_, ring_.corners, fresh_, accept)) return false;
  }
  const StarKind kind = mesh_.star(v, opposite_, most_triangles_);
  if (kind == StarKind::TooMany) return false;
  star_.clear();
  std::vector<BoundaryEdge>& boundary = star_.patch.boundary;
  for (const EdgeRef e : opposite_) {
    star_.patch.triangles.push_back(triOf(e));
    boundary.push_back({mesh_.origin(e), mesh_.target(e), mesh_.twin(e), mesh_.segment(e)});
  }
  if (isBarred(star_)) return false;
  if (mesh_.kind(v) == VertexKind::Free) {
    all_fresh_ = fresh_;
  } else if (kind == StarKind::Open) {
    // On the boundary: the two subsegments become the last side of the hole.
    const SegmentId seg = mesh_.segment(spokeBefore(opposite_.front()));
    if (seg == kNone || mesh_.segment(spokeAfter(opposite_.back())) != seg || boundary.size() < 2) return false;
    if (!fillHole(boundary, accept)) return false;
    all_fresh_ = fresh_;
    boundary.push_back({boundary.back().b, boundary.front().a, kNone, seg});
  } else {
    // Inside the mesh: one hole on either side of the segment.
    const auto isOnSegment = [&](EdgeRef e) { return mesh_.segment(spokeBefore(e)) != kNone; };
    const auto one = std::ranges::find_if(opposite_, isOnSegment);
    if (one == opposite_.end()) return false;
    const auto other = std::find_if(one + 1, opposite_.end(), isOnSegment);
    if (other == opposite_.end()) return false;
    const auto first = static_cast<std::size_t>(one - opposite_.begin());
    const auto beside = static_cast<std::size_t>(other - one);
    if (beside < 2 || boundary.size() - beside < 2) return false;
    std::ranges::rotate(boundary, boundary.begin() + static_cast<std::ptrdiff_t>(first));
    star_.spokes.push_back({boundary[0].a, boundary[beside].a, kNone, mesh_.segment(spokeBefore(*one))});
    if (!fillHole(std::span(boundary).first(beside), accept)) return false;
    all_fresh_ = fresh_;
    if (!fillHole(std::span(boundary).subspan(beside), accept)) return false;
    all_fresh_.insert(all_fresh_.end(), fresh_.begin(), fresh_.end());
  }
  if (flips == Flips::Watched && mayNotFlip(star_) && holeFlips(star_)) return false;
  mesh_.replace(star_.patch, all_fresh_, {&v, 1}, touched, star_.spokes);
  mesh_.restoreDelaunay(touched);
  return true;
}

bool VertexOps::mergeWithNeighbour(VertexId v, bool each_gets_its_turn, std::vector<TriId>& touched) {
  if (mesh_.kind(v) == VertexKind::Free) {
    if (mesh_.ring(v, mesh_.triangleOf(v), most_triangles_ + kMergedAway, ring_) != StarKind::Closed) return false;
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
  if (mesh_.star(v, opposite_, most_triangles_ + kMergedAway) == StarKind::TooMany) return false;
  neighbours_.clear();
  for (const EdgeRef e : opposite_) neighbours_.push_back(mesh_.origin(e));
  if (const VertexId last = mesh_.target(opposite_.back()); last != neighbours_.front()) neighbours_.push_back(last);
  for (const VertexId w : neighbours_) {
    if (mesh_.kind(w) == VertexKind::Input || (each_gets_its_turn && w < v && mesh_.kind(w) == mesh_.kind(v))) continue;
    // The vertex that stays is the one on the segment.
    if (mesh_.kind(w) == VertexKind::Free ? merge(w, v, touched) : merge(v, w, touched)) return true;
  }
  return false;
}

bool VertexOps::merge(VertexId goes, VertexId stays, std::vector<TriId>& touched) {
  if (!gatherBoth(goes, stays, star_)) return false;
  const std::optional<Point> place = findPlace(stays, star_);
  if (!place || !fits(*place) || (mayNotFlip(star_) && fanFlips(star_, *place))) return false;
  all_fresh_.clear();
  for (const BoundaryEdge& r : star_.patch.boundary) all_fresh_.push_back({stays, r.a, r.b});
  mesh_.setPoint(stays, *place);
  star_.patch.boundary.insert(star_.patch.boundary.end(), star_.sides.begin(), star_.sides.end());
  mesh_.replace(star_.patch, all_fresh_, {&goes, 1}, touched, star_.spokes);
  mesh_.restoreDelaunay(touched);
  return true;
}

}  // namespace coastmesh
