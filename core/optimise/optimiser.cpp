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
static_assert(kMostRound <= 64, "StarCost::poor has a bit for each");
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
// Moves to try for them, as shares of the way to the triangle's equilateral apex; of trials at 0.4 one in fifty serves.
constexpr double kPulls[] = {0.15, 0.05};

// Triangles of a better shape have acute angles only in the frame (90 degrees give at most 0.866): edges between two of
// them are Delaunay there and in the plane, since circles of one are circles of the other.
constexpr double kAcuteShape = 0.87;
constexpr double kPoorFlatness = 2.0 * kRootOfThree / kPoorShape;

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
      active_(mesh_.vertexSlots(), 1),
      futile_(mesh_.vertexSlots(), 0) {
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
    if (k + 2 == sweeps) std::ranges::fill(futile_, 0);  // vertices have moved since: once more
    const bool merges = k + 1 < sweeps;                  // vertices around a merge must still move
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
    if (!balances || mesh_.trianglesRound(v) == 6 || (futile_[v] & kBalancing)) continue;
    if (!moved || gatherRing(v)) balance(v);
  }
}

MeshState Optimiser::releaseState() { return releaseDue(mesh_, std::move(due_), waiting_); }

// Gathers the triangles around a free vertex; false if a frozen edge is opposite, or there are too many.
bool Optimiser::gatherRing(VertexId v) {
  segment_ = kNone;
  is_open_ = false;
  return mesh_.ring(v, kMostRound, ring_) && look(v);
}

// Sets the frame at v and the ring's corners in it. False if a frozen edge is opposite.
bool Optimiser::look(VertexId v) {
  frame_ = Frame(bound_.surface, mesh_.point(v));
  seen_.clear();
  for (const VertexId w : ring_.corners) seen_.push_back(frame_.to(mesh_.point(w)));
  // Once around, so that no index wraps.
  if (!is_open_)
    for (const std::size_t i : {0U, 1U}) seen_.push_back(Point(seen_[i]));
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

// Sets what the costs of the ring's triangles share at all places of a vertex.
void Optimiser::noteSectors(VertexId v) {
  sectors_.clear();
  double size = wantedOf(0);
  for (std::size_t i = 0; i < ring_.triangles.size(); ++i) {
    const double next = wantedOf(i + 1), ideal = idealDoubled(meanOf(wanted_[v], size, next));
    const Point along = seen_[i + 1] - seen_[i];
    sectors_.push_back({along, dot(along, along), ideal, 1.0 / ideal});
    size = next;
  }
}

// Cost of the triangles around a vertex if it is at `place` of the frame; infinite if a bound is violated or the cost
// exceeds `limit`.
Optimiser::StarCost Optimiser::costRound(const Point& place, double limit) const {
  constexpr StarCost kTooMuch{std::numeric_limits<double>::infinity(), 0.0, 0};
  StarCost all{0.0, 0.0, 0};
  double worst = 0.0, spoke = squaredDistance(seen_[0], place);
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    const Sector& sector = sectors_[i];
    const double next = squaredDistance(seen_[i + 1], place);
    const double doubled = cross(sector.along, place - seen_[i]), squares = sector.squared + spoke + next;
    if (doubled <= 0.0) return kTooMuch;
    if (!isClear(doubled, squares)) {
      const Point in_plane = frame_.from(place);
      if (orient2d(corner(i), corner(i + 1), in_plane) <= 0 || isBad(corner(i), corner(i + 1), in_plane, bound_))
        return kTooMuch;
    }
    const double inverse = 1.0 / doubled, flatness = squares * inverse;
    all.sum += costOfParts(flatness, doubled * sector.inverse_ideal, sector.ideal * inverse);
    if (all.sum > limit) return kTooMuch;
    worst = std::max(worst, flatness);
    all.poor |= std::uint64_t{flatness > kPoorFlatness} << i;
    spoke = next;
  }
  all.least_shape = 2.0 * kRootOfThree / worst;
  return all;
}

// The same at its present place. `centre` receives the mean of the centroids in the frame, each weighted by its
// triangle's area over the requested one; `poorest` the triangle of the poorest shape, by its index in the ring.
Optimiser::StarCost Optimiser::costHere(VertexId v, Point& centre, std::size_t& poorest) const {
  constexpr double kTooMuch = std::numeric_limits<double>::infinity();
  const Point here = frame_.to(mesh_.point(v));
  StarCost all{0.0, 0.0, 0};
  Point mean;
  double worst = 0.0, weight = 0.0, spoke = squaredDistance(seen_[0], here);
  bool breaks = false;
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    const Sector& sector = sectors_[i];
    const Point from = here - seen_[i];
    const double next = squaredDistance(seen_[i + 1], here);
    const double doubled = cross(sector.along, from), squares = sector.squared + spoke + next;
    breaks = breaks || (!isClear(doubled, squares) && isBad(corner(i), corner(i + 1), mesh_.point(v), bound_));
    const double inverse = 1.0 / doubled, area_share = doubled * sector.inverse_ideal;
    const double flatness = doubled > 0.0 ? squares * inverse : kTooMuch;
    all.sum += doubled > 0.0 ? costOfParts(flatness, area_share, sector.ideal * inverse) : kTooMuch;
    if (flatness > worst) {
      worst = flatness;
      poorest = i;
    }
    all.poor |= std::uint64_t{flatness > kPoorFlatness} << i;
    mean = mean + area_share * (seen_[i + 1] - here - from);
    weight += area_share;
    spoke = next;
  }
  centre = here + (1.0 / (3.0 * weight)) * mean;
  if (breaks) all.sum = kTooMuch;
  all.least_shape = 2.0 * kRootOfThree / worst;
  return all;
}

// The smallest value of the goal around a vertex at `place`, as a share of the required value; at most 1. Of links only
// those of the triangles in `poor` count, unless the goal is Links: others are long enough. REQUIRES: every triangle of
// the star is counter-clockwise there.
double Optimiser::goalAt(VertexId v, const Point& place, std::uint64_t poor) const {
  double least = 1.0;
  const std::size_t count = ring_.triangles.size();
  const auto counts = [&](std::size_t i) { return goal_ == QualityGoal::Links || (poor >> i & 1) != 0; };
  for (std::size_t i = 0; i < count; ++i) {
    const Point &a = seen_[i], &b = seen_[i + 1];
    if (goal_ == QualityGoal::Centred) {
      least = std::min(least, centrednessOf(place, a, b) / kEnoughCentred);
      continue;
    }
    const std::size_t after = i + 1 < count ? i + 1 : 0;
    if ((!is_open_ || after > 0) && (counts(i) || counts(after)))
      least = std::min(least, linkGoal(place, b, seen_[i + 2], a));
    if (!counts(i)) continue;
    const EdgeRef beyond = mesh_.twin(edgeRef(ring_.triangles[i], mesh_.cornerOf(ring_.triangles[i], v)));
    if (beyond == kNone) continue;
    least = std::min(least, linkGoal(a, b, place, frame_.to(mesh_.point(mesh_.apex(beyond)))));
  }
  return least;
}

// The best of some places of the frame for the goal, at which the star costs little more; nullopt if none is better.
std::optional<Optimiser::Move> Optimiser::placeForGoal(VertexId v, const StarCost& now) const {
  constexpr int kDirections = 8;
  constexpr double kMostGoalCost = 1.1;
  const Point here = frame_.to(mesh_.point(v));
  const double most = kMostGoalCost * now.sum;
  double best = goalAt(v, here, now.poor) + kLeastGain;
  for (const double step : {0.2, 0.1, 0.05, 0.025}) {
    std::optional<Move> place;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      const Point to = here + step * wanted_[v] * Point{std::cos(angle), std::sin(angle)};
      const StarCost then = costRound(to, most);
      if (!(then.sum < most)) continue;
      const double goal = goalAt(v, to, then.poor);
      if (goal <= best) continue;
      best = goal;
      place = Move{to, then.least_shape};
    }
    if (place) return place;
  }
  return std::nullopt;
}

// True if a move to `place`, where the star has the measures `then`, keeps the goal, which was at `held`. Links beside
// triangles that are not poor are long enough unless the goal is Links.
bool Optimiser::keepsGoal(VertexId v, const Point& place, const StarCost& then, double held) const {
  return !mends_poor_ || (goal_ == QualityGoal::Shape && then.least_shape >= kPoorShape) ||
         goalAt(v, place, then.poor) >= held;
}

// The place in the frame where a vertex's star costs less or, in later sweeps, its poorest triangle gains at next to no
// cost; nullopt if there is none.
std::optional<Optimiser::Move> Optimiser::betterPlace(VertexId v) {
  const Point here = frame_.to(mesh_.point(v));
  Point to;
  std::size_t poorest = 0;
  noteSectors(v);
  const StarCost now = costHere(v, to, poorest);
  if (!std::isfinite(to.x) || !std::isfinite(to.y)) return std::nullopt;
  if (segment_ != kNone) return betterPlaceOnSegment(v, to, now);
  const double cost = now.sum;
  const bool may_lack = mends_poor_ && (goal_ != QualityGoal::Shape || now.least_shape < kPoorShape);
  const double held = may_lack ? goalAt(v, here, now.poor) : 1.0;
  if (held < 1.0)
    if (const std::optional<Move> place = placeForGoal(v, now)) return place;
  StarCost then;
  const auto isBetter = [&](const Point& place) {
    then = costRound(place, cost);
    return then.sum < cost && keepsGoal(v, place, then, held);
  };
  const double still = kStill * wanted_[v];
  if (goes_far_ && squaredDistance(here, to) >= still * still) {
    const Point beyond = here + kBeyond * (to - here);
    if (isBetter(beyond)) return Move{beyond, then.least_shape};
  }
  for (int attempt = 0; attempt < kAttempts && squaredDistance(here, to) >= still * still; ++attempt) {
    if (isBetter(to)) return Move{to, then.least_shape};
    to = midpoint(here, to);
  }
  if (!mends_poor_ || now.least_shape >= kPoorShape) return std::nullopt;
  const Point &a = seen_[poorest], &b = seen_[poorest + 1];
  const Point apex = midpoint(a, b) + 0.5 * kRootOfThree * Point{a.y - b.y, b.x - a.x};  // equilateral
  for (const double share : kPulls) {
    to = here + share * (apex - here);
    then = costRound(to, kMostCost * cost);
    if (then.sum < kMostCost * cost && then.least_shape > now.least_shape + kLeastGain && keepsGoal(v, to, then, held))
      return Move{to, then.least_shape};
  }
  return std::nullopt;
}

// The same along the vertex's segment; `to` is the target that it would have if it were free.
std::optional<Optimiser::Move> Optimiser::betterPlaceOnSegment(VertexId v, Point to, const StarCost& now) const {
  const Point here = frame_.to(mesh_.point(v));
  // On the input segment itself, so that rounding errors do not add up.
  const Point &from = pslg_.points[pslg_.segments[segment_].a], &end = pslg_.points[pslg_.segments[segment_].b];
  const auto onSegment = [&](const Point& place) { return frame_.to(projectedOnLine(frame_.from(place), from, end)); };
  const double cost = now.sum, held = mends_poor_ ? goalAt(v, here, now.poor) : 1.0, still = kStill * wanted_[v];
  to = onSegment(to);
  for (int attempt = 0; attempt < kAttempts && squaredDistance(here, to) >= still * still; ++attempt) {
    const StarCost then = costRound(to, cost);
    if (then.sum < cost && keepsGoal(v, to, then, held)) return Move{to, then.least_shape};
    to = onSegment(midpoint(here, to));
  }
  if (!mends_poor_ || now.least_shape >= kPoorShape) return std::nullopt;
  double best = now.least_shape + kLeastGain;
  const Point along = seen_[along_[1]] - seen_[along_[0]];
  std::optional<Move> place;
  for (const double share : {0.2, -0.2, 0.1, -0.1, 0.05, -0.05}) {
    to = onSegment(here + share * along);
    const StarCost then = costRound(to, kMostCost * cost);
    if (!(then.sum < kMostCost * cost) || then.least_shape <= best || !keepsGoal(v, to, then, held)) continue;
    best = then.least_shape;
    place = Move{to, then.least_shape};
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
  const std::optional<Move> better = betterPlace(v);
  if (!better) return false;
  const Point to = frame_.from(better->to);
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
    mesh_.restoreDelaunayRound(v, touched_, better->least_shape > kAcuteShape);
  else
    mesh_.restoreDelaunay(touched_);
  ++stats_.relocations;
  if (touched_.size() > ring_.triangles.size()) clearFutile();
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
  clearFutile();
  return true;
}

bool Optimiser::mergeShort(VertexId v) {
  if (futile_[v] & kMerging) return false;
  for (const VertexId w : ring_.corners) {
    const double shortest = kShortest * 0.5 * (wanted_[v] + wanted_[w]);
    if (squaredLengthOf(v, w) > shortest * shortest || mesh_.kind(w) == VertexKind::Input) continue;
    if (mergeInto(v, w)) return true;
    futile_[v] |= kMerging;
  }
  return false;
}

// The number of triangles around a vertex minus six, or on the boundary minus one for each 60 degrees.
int Optimiser::excess(VertexId v) {
  int ideal = 6;
  if (mesh_.kind(v) == VertexKind::Free) return static_cast<int>(mesh_.trianglesRound(v)) - ideal;
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
  if (with != kNone && !mergeInto(v, with)) futile_[v] |= kBalancing;
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
    if (!exchange_.tryExchange(v, w, left, right, touched_)) {
      futile_[v] |= kBalancing;
      continue;
    }
    for (const VertexId u : {v, w, left, right}) {
      if (size_ != nullptr) wanted_[u] = wantedAt(u);
      ++stats_.relocations;
    }
    wake();
    clearFutile();
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

// Lets the corners of all changed triangles merge and be balanced again.
void Optimiser::clearFutile() {
  for (const TriId t : touched_)
    if (mesh_.isLive(t))
      for (const VertexId w : mesh_.triangle(t).v) futile_[w] = 0;
}

}  // namespace coastmesh
