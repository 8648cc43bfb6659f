#include "core/optimise/optimiser.hpp"

#include <algorithm>

#include "core/predicates.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/submesh_runs.hpp"

namespace coastmesh {

namespace {

// The ends of edges shorter than this share of the requested length are merged.
constexpr double kShortest = 0.7;
// A move that violates a bound or costs more is tried again at half and a quarter of the distance.
constexpr int kAttempts = 3;
// Vertices with more triangles are skipped.
constexpr std::size_t kMostRound = 64;
// Moves by less than kStill of the requested length are skipped; after moves by less than kStirs the neighbours stay at
// rest.
constexpr double kStill = 0.02, kStirs = 0.05;
// In the first sweeps vertices first try to move this much farther than their target, which their neighbours' moves
// will shift the same way: successive over-relaxation.
constexpr double kBeyond = 1.5;
constexpr int kFarSweeps = 4;
// Sweeps before numbers of neighbours are balanced, and sweeps without that at the end.
constexpr int kFirstBalance = 1, kSettle = 2;
// Poor triangles are improved in the second half of the sweeps, if they gain at least kLeastGain and their star costs
// at most kMostCost times as much.
constexpr double kLeastGain = 0.002, kMostCost = 1.005;

// Increase of the square of a vertex's excess if it gets `more` triangles.
int imbalanceAdded(int excess, int more) { return more * (2 * excess + more); }

// The shape above which no angle can violate its bound; infinite if lengths are bounded too.
double clearShapeOf(const TriangleBound& bound) {
  constexpr double kRounding = 1e-9, kCurved = 1e-3;  // errors of shapes in the plane, and in a frame
  if (!std::isinf(bound.squared_size)) return std::numeric_limits<double>::infinity();
  double shape = bestShapeWith(bound.min_angle);
  if (bound.max_angle < std::numbers::pi) shape = std::max(shape, bestShapeWith(bound.max_angle));
  return shape + (bound.surface.isCurved() ? kCurved : kRounding);
}

}  // namespace

Optimiser::Optimiser(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options)
    : pslg_(pslg),
      options_(options),
      size_(options.size),
      goal_(options.goal),
      bound_(strictBoundOf(options)),
      mesh_(std::move(mesh)),
      ops_(mesh_, pslg, bound_),
      exchange_(mesh_, ops_, bound_, wanted_),
      clear_shape_(clearShapeOf(bound_)),
      flips_may_harm_(bound_.max_angle < std::numbers::pi || !std::isinf(bound_.squared_size)),
      wanted_(mesh_.vertexSlots(), 0.0),
      active_(mesh_.vertexSlots(), 1) {
  ops_.keepBadInPlace();
  noteWanted();
  for (TriId t = 0; t < mesh_.triangleSlots() && !any_bad_; ++t)
    any_bad_ = isBad(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), bound_);
}

Optimiser::Optimiser(MeshState&& state, const Pslg& pslg, const RefineOptions& options)
    : Optimiser(std::move(state.mesh), pslg, options) {
  ops_.keepClearOfFrozen();
  is_submesh_ = true;
  due_ = std::move(state.due_vertices);
}

void Optimiser::run(int sweeps, const RunControl& control) {
  const int all = sweeps + (size_ == nullptr ? 0 : kSettle);
  const auto shareOf = [&](int done) { return static_cast<double>(done) / all; };
  for (int k = 0; k < sweeps; ++k) {
    mends_poor_ = k >= sweeps / 2;
    if (k == sweeps / 2) wakePoor();
    goes_far_ = k < kFarSweeps;
    const bool merges = k + 1 < sweeps;  // vertices around a merge must still move
    sweep(merges, k >= kFirstBalance && k + kSettle < sweeps, control, shareOf(k), shareOf(k + 1));
  }
  goes_far_ = false;
  if (size_ == nullptr) return;  // the aim is as few vertices as possible
  mendPoorest(control, shareOf(sweeps));
  for (int k = sweeps; k < all; ++k) sweep(false, false, control, shareOf(k), shareOf(k + 1));
  if (options_.least_edge > 0.0) mendShortEdges(control, 1.0);
}

void Optimiser::sweep(bool merges, bool balances, const RunControl& control, double from, double to) {
  for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); ++v) {
    if (v % 1024 == 0) control.checkpoint(from + (to - from) * static_cast<double>(v) / mesh_.vertexSlots());
    if (!active_[v] || !mesh_.isLiveVertex(v) || !isDue(v)) continue;
    active_[v] = 0;
    if (mesh_.kind(v) != VertexKind::Free) {
      if (size_ != nullptr && gatherOnSegment(v)) move(v);
      continue;
    }
    if (!gatherRing(v) || (merges && mergeShort(v))) continue;
    const bool moved = move(v);
    if (balances && (!moved || gatherRing(v))) balance(v);
  }
}

MeshState Optimiser::releaseState() { return releaseDue(mesh_, std::move(due_), waiting_); }

// Gathers the triangles around a free vertex; false if a frozen edge is opposite, or there are too many.
bool Optimiser::gatherRing(VertexId v) {
  segment_ = kNone;
  is_open_ = false;
  return mesh_.ring(v, mesh_.triangleOf(v), kMostRound, ring_) == StarKind::Closed && look(v);
}

// Sets the frame at v and the ring's corners in it. False if a frozen edge is opposite.
bool Optimiser::look(VertexId v) {
  frame_ = Frame(bound_.surface, mesh_.point(v));
  if (frame_.isCurved()) {
    seen_.clear();
    for (const VertexId w : ring_.corners) seen_.push_back(frame_.to(mesh_.point(w)));
  }
  const auto isFrozen = [&](TriId t) { return mesh_.segment(edgeRef(t, mesh_.cornerOf(t, v))) == kFrozen; };
  return !is_submesh_ || std::ranges::none_of(ring_.triangles, isFrozen);
}

// The segment of the edge from the ring's vertex to corner i.
SegmentId Optimiser::segmentTo(VertexId v, std::size_t i) const {
  const bool is_last = i == ring_.triangles.size();
  const TriId t = ring_.triangles[is_last ? i - 1 : i];
  const unsigned at = mesh_.cornerOf(t, v);
  return mesh_.segment(edgeRef(t, is_last ? next3(at) : prev3(at)));
}

// Like gatherRing for a vertex inside an input segment; false if it is not.
bool Optimiser::gatherOnSegment(VertexId v) {
  const StarKind kind = mesh_.star(v, star_, kMostRound);
  if (kind == StarKind::TooMany) return false;
  is_open_ = kind == StarKind::Open;
  ring_.corners.clear();
  ring_.triangles.clear();
  for (const EdgeRef e : star_) {
    ring_.corners.push_back(mesh_.origin(e));
    ring_.triangles.push_back(triOf(e));
  }
  if (is_open_) ring_.corners.push_back(mesh_.target(star_.back()));
  segment_ = kNone;
  std::size_t ends = 0;
  for (std::size_t i = 0; i < ring_.corners.size(); ++i) {
    const SegmentId seg = segmentTo(v, i);
    if (seg == kNone) continue;
    if (seg >= pslg_.segments.size() || ends == 2 || (ends == 1 && seg != segment_)) return false;
    segment_ = seg;
    along_[ends++] = i;
  }
  return ends == 2 && look(v);
}

// Sets the requested lengths of all vertices.
void Optimiser::noteWanted() {
  const auto isOnShore = [&](VertexId v) { return mesh_.kind(v) != VertexKind::Free; };
  for (VertexId v = 0; v < mesh_.vertexSlots(); ++v) {
    if (!mesh_.isLiveVertex(v)) continue;
    wanted_[v] = size_ == nullptr || isOnShore(v) ? wantedAt(v) : size_->at(mesh_.point(v));
  }
}

// The requested length at a vertex. On a shore at most the mean of its constrained edges, since the shore may be finer;
// without sizes the mean of its edges.
double Optimiser::wantedAt(VertexId v) {
  double wanted = size_ == nullptr ? std::numeric_limits<double>::infinity() : size_->at(mesh_.point(v));
  const bool is_free = mesh_.kind(v) == VertexKind::Free;
  if (is_free && size_ != nullptr) return wanted;
  double sum = 0.0;
  int count = 0;
  const auto add = [&](EdgeRef e) {
    if (!is_free && size_ != nullptr && !mesh_.isConstrained(e)) return;
    sum += std::sqrt(squaredLengthOf(mesh_.origin(e), mesh_.target(e)));
    ++count;
  };
  mesh_.star(v, star_);
  for (const EdgeRef e : star_) {
    add(edgeRef(triOf(e), next3(indexOf(e))));
    add(edgeRef(triOf(e), prev3(indexOf(e))));
  }
  return count == 0 ? wanted : std::min(wanted, sum / count);
}

// Cost of the triangles around a vertex if it is at `place` of the frame; infinite if a bound is violated or the cost
// exceeds `limit`.
Optimiser::StarCost Optimiser::costRound(const Point& place, double wanted, double limit) const {
  constexpr StarCost kTooMuch{std::numeric_limits<double>::infinity(), 0.0};
  const Point in_plane = frame_.from(place);
  double sum = 0.0, worst = 0.0;
  Point a = seen(0);
  double size = wantedOf(0);
  for (std::size_t i = 0; i < ring_.triangles.size(); ++i) {
    const Point& b = seen(i + 1);
    const double next = wantedOf(i + 1), doubled = cross(b - a, place - a), squares = squaresOf(a, b, place);
    if (doubled <= 0.0) return kTooMuch;
    if (!isClear(doubled, squares) &&
        (orient2d(corner(i), corner(i + 1), in_plane) <= 0 || isBad(corner(i), corner(i + 1), in_plane, bound_)))
      return kTooMuch;
    const TriangleCost own = costWithParts(doubled, squares, meanOf(wanted, size, next));
    sum += own.cost;
    if (sum > limit) return kTooMuch;
    worst = std::max(worst, own.flatness);
    a = b;
    size = next;
  }
  return {sum, 2.0 * kRootOfThree / worst};
}

// The same at its present place. `centre` receives the mean of the centroids in the frame, each weighted by its
// triangle's area over the requested one.
Optimiser::StarCost Optimiser::costHere(VertexId v, Point& centre) const {
  constexpr double kTooMuch = std::numeric_limits<double>::infinity();
  const Point here = frame_.to(mesh_.point(v));
  Point mean, a = seen(0);
  double sum = 0.0, worst = 0.0, weight = 0.0, size = wantedOf(0);
  const double own_size = wanted_[v];
  bool breaks = false;
  for (std::size_t i = 0; i < ring_.triangles.size(); ++i) {
    const Point& b = seen(i + 1);
    const double next = wantedOf(i + 1), wanted = meanOf(own_size, size, next);
    const double doubled = cross(b - a, here - a), squares = squaresOf(a, b, here);
    breaks = breaks || (!isClear(doubled, squares) && isBad(corner(i), corner(i + 1), mesh_.point(v), bound_));
    TriangleCost own = costWithParts(doubled, squares, wanted);
    if (!(doubled > 0.0)) own = {kTooMuch, kTooMuch, doubled / (0.5 * kRootOfThree * wanted * wanted)};
    sum += own.cost;
    worst = std::max(worst, own.flatness);
    mean = mean + own.area_share * (a - here + (b - here));
    weight += own.area_share;
    a = b;
    size = next;
  }
  centre = here + (1.0 / (3.0 * weight)) * mean;
  return {breaks ? kTooMuch : sum, 2.0 * kRootOfThree / worst};
}

// The triangle of the poorest shape if the vertex is at `place`, by its index in the ring; the first of equal ones.
std::size_t Optimiser::poorestAt(const Point& place) const {
  std::size_t poorest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring_.triangles.size(); ++i) {
    const double shape = shapeOf(seen(i), seen(i + 1), place);
    if (shape < least) {
      least = shape;
      poorest = i;
    }
  }
  return poorest;
}

// The smallest value of the goal around a vertex at `place`, as a share of the required value; at most 1. REQUIRES:
// every triangle of the star is counter-clockwise there.
double Optimiser::goalAt(VertexId v, const Point& place) const {
  double least = 1.0;
  for (std::size_t i = 0; i < ring_.triangles.size(); ++i) {
    const Point &a = seen(i), &b = seen(i + 1);
    if (goal_ == QualityGoal::Centred) {
      least = std::min(least, centrednessOf(place, a, b) / kEnoughCentred);
      continue;
    }
    if (!is_open_ || i + 1 < ring_.triangles.size()) least = std::min(least, linkGoal(place, b, seen(i + 2), a));
    const EdgeRef beyond = mesh_.twin(edgeRef(ring_.triangles[i], mesh_.cornerOf(ring_.triangles[i], v)));
    if (beyond == kNone) continue;
    least = std::min(least, linkGoal(a, b, place, frame_.to(mesh_.point(mesh_.apex(beyond)))));
  }
  return least;
}

// The best of some places of the frame for the goal, at which the star costs little more; nullopt if none is better.
std::optional<Point> Optimiser::placeForGoal(VertexId v, double cost) const {
  constexpr int kDirections = 8;
  constexpr double kMostGoalCost = 1.1;
  const Point here = frame_.to(mesh_.point(v));
  double best = goalAt(v, here) + kLeastGain;
  for (const double step : {0.2, 0.1, 0.05, 0.025}) {
    std::optional<Point> place;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      const Point to = here + step * wanted_[v] * Point{std::cos(angle), std::sin(angle)};
      if (!(costRound(to, wanted_[v], kMostGoalCost * cost).sum < kMostGoalCost * cost)) continue;
      const double then = goalAt(v, to);
      if (then <= best) continue;
      best = then;
      place = to;
    }
    if (place) return place;
  }
  return std::nullopt;
}

// True if a move to `place`, where the star has the measures `then`, keeps the goal, which was at `held`. Links beside
// triangles that are not poor are long enough unless the goal is Links.
bool Optimiser::keepsGoal(VertexId v, const Point& place, const StarCost& then, double held) const {
  return !mends_poor_ || (goal_ == QualityGoal::Shape && then.least_shape >= kPoorShape) || goalAt(v, place) >= held;
}

// The place in the frame where a vertex's star costs less or, in later sweeps, its poorest triangle gains at next to no
// cost; nullopt if there is none.
std::optional<Point> Optimiser::betterPlace(VertexId v) const {
  const Point here = frame_.to(mesh_.point(v));
  Point to;
  const StarCost now = costHere(v, to);
  if (!std::isfinite(to.x) || !std::isfinite(to.y)) return std::nullopt;
  if (segment_ != kNone) return betterPlaceOnSegment(v, to, now);
  const double cost = now.sum;
  const bool may_lack = mends_poor_ && (goal_ != QualityGoal::Shape || now.least_shape < kPoorShape);
  const double held = may_lack ? goalAt(v, here) : 1.0;
  if (held < 1.0)
    if (const std::optional<Point> place = placeForGoal(v, cost)) return place;
  const auto isBetter = [&](const Point& place) {
    const StarCost then = costRound(place, wanted_[v], cost);
    return then.sum < cost && keepsGoal(v, place, then, held);
  };
  const double still = kStill * wanted_[v];
  if (goes_far_ && squaredDistance(here, to) >= still * still) {
    const Point beyond = here + kBeyond * (to - here);
    if (isBetter(beyond)) return beyond;
  }
  for (int attempt = 0; attempt < kAttempts && squaredDistance(here, to) >= still * still; ++attempt) {
    if (isBetter(to)) return to;
    to = midpoint(here, to);
  }
  if (!mends_poor_ || now.least_shape >= kPoorShape) return std::nullopt;
  const std::size_t poorest = poorestAt(here);
  const Point &a = seen(poorest), &b = seen(poorest + 1);
  const Point apex = midpoint(a, b) + 0.5 * kRootOfThree * Point{a.y - b.y, b.x - a.x};  // equilateral
  double share = 0.4;
  for (int attempt = 0; attempt < kAttempts; ++attempt, share *= 0.5) {
    to = here + share * (apex - here);
    const StarCost then = costRound(to, wanted_[v], kMostCost * cost);
    if (then.sum < kMostCost * cost && then.least_shape > now.least_shape + kLeastGain && keepsGoal(v, to, then, held))
      return to;
  }
  return std::nullopt;
}

// The same along the vertex's segment; `to` is the target that it would have if it were free.
std::optional<Point> Optimiser::betterPlaceOnSegment(VertexId v, Point to, const StarCost& now) const {
  const Point here = frame_.to(mesh_.point(v));
  // On the input segment itself, so that rounding errors do not add up.
  const Point &from = pslg_.points[pslg_.segments[segment_].a], &end = pslg_.points[pslg_.segments[segment_].b];
  const auto onSegment = [&](const Point& place) { return frame_.to(projectedOnLine(frame_.from(place), from, end)); };
  const double cost = now.sum, held = mends_poor_ ? goalAt(v, here) : 1.0, still = kStill * wanted_[v];
  to = onSegment(to);
  for (int attempt = 0; attempt < kAttempts && squaredDistance(here, to) >= still * still; ++attempt) {
    const StarCost then = costRound(to, wanted_[v], cost);
    if (then.sum < cost && keepsGoal(v, to, then, held)) return to;
    to = onSegment(midpoint(here, to));
  }
  if (!mends_poor_ || now.least_shape >= kPoorShape) return std::nullopt;
  double best = now.least_shape + kLeastGain;
  const Point along = seen(along_[1]) - seen(along_[0]);
  std::optional<Point> place;
  for (const double share : {0.2, -0.2, 0.1, -0.1, 0.05, -0.05}) {
    to = onSegment(here + share * along);
    const StarCost then = costRound(to, wanted_[v], kMostCost * cost);
    if (!(then.sum < kMostCost * cost) || then.least_shape <= best || !keepsGoal(v, to, then, held)) continue;
    best = then.least_shape;
    place = to;
  }
  return place;
}

// True if the Delaunay property requires flips around a vertex at `place`.
bool Optimiser::flipsAt(VertexId v, const Point& place) const {
  for (std::size_t i = 0; i < ring_.triangles.size(); ++i) {
    const TriId t = ring_.triangles[i];
    const EdgeRef opposite = edgeRef(t, mesh_.cornerOf(t, v));
    const bool is_last = is_open_ && i + 1 == ring_.triangles.size();
    if (!is_last && (segment_ == kNone || segmentTo(v, (i + 1) % ring_.corners.size()) == kNone) &&
        inCircle(place, corner(i), corner(i + 1), corner(i + 2)) > 0)
      return true;
    if (!mesh_.isConstrained(opposite) &&
        inCircle(place, corner(i), corner(i + 1), mesh_.point(mesh_.apex(mesh_.twin(opposite)))) > 0)
      return true;
  }
  return false;
}

// Returns whether the vertex has moved.
bool Optimiser::move(VertexId v) {
  const std::optional<Point> better = betterPlace(v);
  if (!better) return false;
  const Point to = frame_.from(*better);
  const auto isBesideBad = [&](TriId t) { return ops_.isBadBeyond(mesh_.twin(edgeRef(t, mesh_.cornerOf(t, v)))); };
  if ((any_bad_ && std::ranges::any_of(ring_.triangles, isBesideBad)) || (flips_may_harm_ && flipsAt(v, to)))
    return false;
  const double stirs = kStirs * wanted_[v];
  const bool is_far = bound_.surface.squaredChord(mesh_.point(v), to) >= stirs * stirs;
  mesh_.setPoint(v, to);
  if (segment_ != kNone) {
    wanted_[v] = wantedAt(v);
  } else if (size_ != nullptr && is_far) {
    wanted_[v] = size_->at(to);
  }
  touched_.assign(ring_.triangles.begin(), ring_.triangles.end());
  if (segment_ == kNone)
    mesh_.restoreDelaunayRound(v, touched_);
  else
    mesh_.restoreDelaunay(touched_);
  ++stats_.relocations;
  if (is_far)
    wake();
  else
    active_[v] = 1;
  return true;
}

bool Optimiser::mergeInto(VertexId v, VertexId stays) {
  touched_.clear();
  if (!ops_.merge(v, stays, touched_)) return false;
  wanted_[stays] = wantedAt(stays);
  ++stats_.merges;
  wake();
  return true;
}

bool Optimiser::mergeShort(VertexId v) {
  for (const VertexId w : ring_.corners) {
    const double shortest = kShortest * 0.5 * (wanted_[v] + wanted_[w]);
    if (squaredLengthOf(v, w) > shortest * shortest || mesh_.kind(w) == VertexKind::Input) continue;
    if (mergeInto(v, w)) return true;
  }
  return false;
}

// The number of triangles around a vertex minus six, or on the boundary minus one for each 60 degrees.
int Optimiser::excess(VertexId v) {
  int ideal = 6;
  if (mesh_.star(v, star_) == StarKind::Open) {
    const Point here = mesh_.point(v);
    double angle = 0.0;
    for (const EdgeRef e : star_) angle += angleAt(here, mesh_.point(mesh_.origin(e)), mesh_.point(mesh_.target(e)));
    ideal = std::max(1, static_cast<int>(std::lround(angle / (std::numbers::pi / 3.0))));
  }
  return static_cast<int>(star_.size()) - ideal;
}

// Fills excesses_, in the order of the ring's corners.
void Optimiser::countExcesses() {
  excesses_.clear();
  for (const VertexId w : ring_.corners) excesses_.push_back(excess(w));
}

// Balances the numbers of neighbours at v, whose ring is ring_.
void Optimiser::balance(VertexId v) {
  if (ring_.corners.size() < 6)
    mergeTooFew(v);
  else if (ring_.corners.size() > 6)
    exchangeTooMany(v);
}

// Merges a vertex with the neighbour that leaves the numbers of neighbours closest to ideal, if that is an improvement.
void Optimiser::mergeTooFew(VertexId v) {
  const std::vector<VertexId>& corners = ring_.corners;
  const int count = static_cast<int>(corners.size());
  const int own = (count - 6) * (count - 6);
  countExcesses();
  int best = 0;
  VertexId with = kNone;
  for (int i = 0; i < count; ++i) {
    const VertexId w = corners[i];
    if (mesh_.kind(w) == VertexKind::Input || !isDue(w)) continue;
    const double longest = 0.5 * (wanted_[v] + wanted_[w]);
    if (squaredLengthOf(v, w) > longest * longest) continue;
    const int added = imbalanceAdded(excesses_[i], count - 4) - own + imbalanceAdded(excesses_[(i + 1) % count], -1) +
                      imbalanceAdded(excesses_[(i + count - 1) % count], -1);
    if (added < best) {
      best = added;
      with = w;
    }
  }
  if (with != kNone) mergeInto(v, with);
}

void Optimiser::exchangeTooMany(VertexId v) {
  const std::vector<VertexId>& corners = ring_.corners;
  const auto isOurs = [&](VertexId u) { return mesh_.kind(u) == VertexKind::Free && isDue(u); };
  const std::size_t count = corners.size();
  const int own = imbalanceAdded(static_cast<int>(count) - 6, -1);
  countExcesses();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t after = (i + 1) % count, before = (i + count - 1) % count;
    const VertexId w = corners[i], left = corners[after], right = corners[before];
    if (!isOurs(w) || !isOurs(left) || !isOurs(right)) continue;
    if (own + imbalanceAdded(excesses_[i], -1) + imbalanceAdded(excesses_[after], 1) +
            imbalanceAdded(excesses_[before], 1) >=
        0)
      continue;
    touched_.clear();
    if (!exchange_.tryExchange(v, w, left, right, touched_)) continue;
    for (const VertexId u : {v, w, left, right}) {
      if (size_ != nullptr) wanted_[u] = wantedAt(u);
      ++stats_.relocations;
    }
    wake();
    return;
  }
}

// Activates the corners of poor triangles, whose improvement begins now.
void Optimiser::wakePoor() {
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t)
    if (mesh_.isLive(t) && isPoor(t))
      for (const VertexId v : mesh_.triangle(t).v) active_[v] = 1;
}

// Activates the corners of all changed triangles.
void Optimiser::wake() {
  for (const TriId t : touched_)
    if (mesh_.isLive(t))
      for (const VertexId w : mesh_.triangle(t).v) active_[w] = 1;
}

}  // namespace coastmesh
