#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "core/optimise/optimiser.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// Weight, in a patch's cost, of the shortfall of shapes below kPoorShape. A patch is used if its cost falls by
// kLeastGain.
constexpr double kPoorWeight = 5.0, kLeastGain = 0.02;
// Layers of touching triangles in a patch, and sweeps over its vertices.
constexpr unsigned kRings = 2;
constexpr int kTurns = 3, kTurnsForGoals = 5;
// A vertex is not removed if it has more triangles than this, or edges shorter on average than this share of the
// requested length. None is inserted at an edge of a triangle, or into its middle, with a smaller share of the
// requested area, nor onto a subsegment no longer than requested. Of the other attempts about one in a hundred
// succeeded.
constexpr std::size_t kMostTriangles = 5;
constexpr double kLeastRemoved = 0.8, kLeastDivided = 0.8, kLeastDividedInMiddle = 1.1;
// An attempt is given up if, after the first sweeps, its cost is this far above the best.
constexpr int kFirstTurns = 1;
constexpr double kHopeless = 0.25;
// No edge gets shorter than this share of the requested length, or than the shortest edge of its patch if that is
// shorter: the shortest edge determines a model's time step.
constexpr double kShort = 0.6;
// Patches to try, as a share of the triangles, with more for each success, up to the last share: where most poor
// triangles cannot be improved, the input is finer than the requested lengths. Goals other than shape start with more.
constexpr double kFirstPatches = 0.012, kFirstForGoals = 0.03, kMostPatches = 0.05;
constexpr double kMoreForGain = 2.5;
// In place of a corner: inserts into the middle, not at an edge's equilateral apex.
constexpr unsigned kCentre = 3;

}  // namespace

Optimiser::Optimiser(const Submesh& patch, const Optimiser& parent)
    : pslg_(parent.pslg_),
      options_(parent.options_),
      size_(parent.size_),
      goal_(parent.goal_),
      bound_(parent.bound_),
      mesh_(TriMesh(patch.mesh)),
      ops_(mesh_, pslg_, bound_),
      exchange_(mesh_, ops_, bound_, wanted_),
      clear_shape_(parent.clear_shape_),
      flips_may_harm_(parent.flips_may_harm_),
      is_submesh_(true),
      mends_poor_(true),
      active_(mesh_.vertexSlots(), 1),
      futile_(mesh_.vertexSlots(), 0) {
  ops_.keepClearOfFrozen();
  for (const VertexId v : patch.parent) wanted_.push_back(parent.wanted_[v]);
}

double Optimiser::shapeOfTriangle(TriId t) const {
  const Corners& v = mesh_.triangle(t).v;
  const Frame frame(bound_.surface, mesh_.point(v[0]));
  return shapeOf(frame.to(mesh_.point(v[0])), frame.to(mesh_.point(v[1])), frame.to(mesh_.point(v[2])));
}

// True if a triangle's shape is poor or misses the goal. Links between two triangles that are not poor are long enough
// unless the goal is Links.
bool Optimiser::isPoor(TriId t) const {
  if (goal_ == QualityGoal::Links || shapeOfTriangle(t) < kPoorShape) return true;
  if (goal_ != QualityGoal::Centred) return false;
  const Corners& v = mesh_.triangle(t).v;
  const Frame frame(bound_.surface, mesh_.point(v[0]));
  return centrednessOf(frame.to(mesh_.point(v[0])), frame.to(mesh_.point(v[1])), frame.to(mesh_.point(v[2]))) <
         kEnoughCentred;
}

// The cost of all triangles beyond that of equilateral ones; infinite if one violates a bound.
double Optimiser::costOfAll() const {
  double sum = 0.0;
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t) {
    if (!mesh_.isLive(t)) continue;
    const Corners& v = mesh_.triangle(t).v;
    const Frame frame(bound_.surface, mesh_.point(v[0]));
    const Point a = frame.to(mesh_.point(v[0])), b = frame.to(mesh_.point(v[1])), c = frame.to(mesh_.point(v[2]));
    const double doubled = cross(b - a, c - a), squares = squaresOf(a, b, c);
    if (doubled <= 0.0 ||
        (!isClear(doubled, squares) && isBad(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), bound_)))
      return std::numeric_limits<double>::infinity();
    sum += costOf(doubled, squares, meanOf(wanted_[v[0]], wanted_[v[1]], wanted_[v[2]])) - kLeastTriangleCost +
           kPoorWeight * std::max(0.0, kPoorShape - 2.0 * kRootOfThree * doubled / squares);
  }
  return sum;
}

// The smallest value of the goal in all triangles, as in `goalAt`.
double Optimiser::goalOfAll() const {
  double least = 1.0;
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t) {
    if (!mesh_.isLive(t)) continue;
    const Corners& v = mesh_.triangle(t).v;
    const Frame frame(bound_.surface, mesh_.point(v[0]));
    const std::array seen{frame.to(mesh_.point(v[0])), frame.to(mesh_.point(v[1])), frame.to(mesh_.point(v[2]))};
    if (goal_ == QualityGoal::Centred) {
      least = std::min(least, centrednessOf(seen[0], seen[1], seen[2]) / kEnoughCentred);
      continue;
    }
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef beyond = mesh_.twin(edgeRef(t, i));
      if (beyond == kNone || beyond < edgeRef(t, i)) continue;
      const Point apex = frame.to(mesh_.point(mesh_.apex(beyond)));
      least = std::min(least, linkGoal(seen[next3(i)], seen[prev3(i)], seen[i], apex));
    }
  }
  return least;
}

void Optimiser::noteAdded(VertexId v) {
  wanted_.resize(mesh_.vertexSlots());
  active_.resize(mesh_.vertexSlots(), 1);
  futile_.resize(mesh_.vertexSlots(), 0);
  if (!due_.empty()) due_.resize(mesh_.vertexSlots(), 1);
  active_[v] = 1;
  futile_[v] = 0;
  if (!due_.empty()) due_[v] = 1;
  wanted_[v] = wantedAt(v);
}

// True if a change of a patch's first triangle may help.
bool Optimiser::isWorthTrying(const Trial& trial) {
  constexpr TriId kFirst = 0;
  const Corners& v = mesh_.triangle(kFirst).v;
  const double wanted = meanOf(wanted_[v[0]], wanted_[v[1]], wanted_[v[2]]);
  if (trial.change == Change::Insert) {
    const double least = trial.corner == kCentre ? kLeastDividedInMiddle : kLeastDivided;
    const Frame frame(bound_.surface, mesh_.point(v[0]));
    const Point a = frame.to(mesh_.point(v[0])), b = frame.to(mesh_.point(v[1])), c = frame.to(mesh_.point(v[2]));
    return cross(b - a, c - a) > least * 0.5 * kRootOfThree * wanted * wanted;
  }
  if (trial.change == Change::Split) {
    const EdgeRef e = edgeRef(kFirst, trial.corner);
    return mayDivide(pslg_, mesh_.segment(e)) && squaredLengthOf(mesh_.origin(e), mesh_.target(e)) > wanted * wanted;
  }
  if (trial.change != Change::Remove) return true;
  const VertexId u = v[trial.corner];
  if (mesh_.kind(u) != VertexKind::Free) return mesh_.kind(u) != VertexKind::Input;
  mesh_.star(u, star_);
  if (star_.size() > kMostTriangles) return false;
  double sum = 0.0;
  for (const EdgeRef e : star_) sum += std::sqrt(squaredLengthOf(u, mesh_.origin(e)));
  return sum > kLeastRemoved * wanted_[u] * static_cast<double>(star_.size());
}

// Splits a subsegment of the input in the middle. Returns false if that is impossible.
bool Optimiser::halveSegment(EdgeRef e) {
  const SegmentId seg = mesh_.segment(e);
  if (!mayDivide(pslg_, seg)) return false;
  const VertexId a = mesh_.origin(e), b = mesh_.target(e);
  const Segment& whole = pslg_.segments[seg];
  const Point x =
      projectedOnLine(midpoint(mesh_.point(a), mesh_.point(b)), pslg_.points[whole.a], pslg_.points[whole.b]);
  touched_.clear();
  const VertexId middle = mesh_.splitSegment(e, x, touched_);
  if (middle == kNone) return false;
  noteAdded(middle);
  wanted_[a] = wantedAt(a);
  wanted_[b] = wantedAt(b);
  return true;
}

// Applies a trial to a patch's first triangle. Returns false if that is impossible.
bool Optimiser::change(const Trial& trial) {
  constexpr TriId kFirst = 0;
  touched_.clear();
  const Corners v = mesh_.triangle(kFirst).v;
  switch (trial.change) {
    case Change::None:
      return true;
    case Change::Remove:
      return mesh_.kind(v[trial.corner]) != VertexKind::Input && ops_.removeAnyway(v[trial.corner], touched_);
    case Change::Insert: {
      Patch cavity;
      Point x = centroid(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]));
      TriId home = kFirst;
      if (trial.corner != kCentre) {
        const Point &a = mesh_.point(v[next3(trial.corner)]), &b = mesh_.point(v[prev3(trial.corner)]);
        x = midpoint(a, b) + 0.5 * kRootOfThree * Point{a.y - b.y, b.x - a.x};
        home = mesh_.locate(x, kFirst).triangle;
        if (home == kNone) return false;
      }
      if (!mesh_.findCavity(x, home, cavity)) return false;
      noteAdded(mesh_.insertInCavity(x, cavity, touched_));
      return true;
    }
    case Change::Split:
      return halveSegment(edgeRef(kFirst, trial.corner));
    case Change::RemoveShort:
      return takeOutShort();
  }
  return false;
}

// True if a patch is next to a frozen edge of the mesh, which is then part of a larger one.
bool Optimiser::isHeldByFrozen(const Submesh& patch) const {
  return std::ranges::any_of(patch.frozen, [&](EdgeRef e) { return mesh_.segment(e) == kFrozen; });
}

// True if the Delaunay property requires flips between a solved patch and its surroundings.
bool Optimiser::wouldFlip(const Submesh& patch, const TriMesh& solved) const {
  for (const Triangle& t : solved.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      if (t.seg[i] != kFrozen) continue;
      const VertexId a = patch.parent[t.v[next3(i)]], b = patch.parent[t.v[prev3(i)]];
      const auto e =
          std::ranges::find_if(patch.frozen, [&](EdgeRef f) { return mesh_.origin(f) == a && mesh_.target(f) == b; });
      if (e == patch.frozen.end() || mesh_.isConstrained(*e)) continue;
      const Point& beyond = mesh_.point(mesh_.apex(mesh_.twin(*e)));
      if (inCircle(solved.points[t.v[0]], solved.points[t.v[1]], solved.points[t.v[2]], beyond) > 0) return true;
    }
  }
  return false;
}

// The shortest edge, as a share of the requested length there. At the shore that is evaluated anew: wanted_ is smaller
// where the shore is finer.
double Optimiser::shortestShare() const {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](EdgeRef e) {
    if (const EdgeRef twin = mesh_.twin(e); twin != kNone && twin < e) return;
    const VertexId a = mesh_.origin(e), b = mesh_.target(e);
    const bool is_inside = mesh_.kind(a) == VertexKind::Free && mesh_.kind(b) == VertexKind::Free;
    const double wanted =
        is_inside ? 0.5 * (wanted_[a] + wanted_[b]) : size_->at(midpoint(mesh_.point(a), mesh_.point(b)));
    least = std::min(least, bound_.surface.chord(mesh_.point(a), mesh_.point(b)) / wanted);
  };
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t)
    for (unsigned i = 0; i < 3 && mesh_.isLive(t); ++i) look(edgeRef(t, i));
  return least;
}

double Optimiser::longestEdge() const {
  double longest = 0.0;
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t)
    for (unsigned i = 0; i < 3 && mesh_.isLive(t); ++i)
      longest = std::max(longest, squaredLengthOf(mesh_.origin(edgeRef(t, i)), mesh_.target(edgeRef(t, i))));
  return std::sqrt(longest);
}

// The best result of the trials in a patch; nullopt if none is better than the patch as it is.
std::optional<TriMesh> Optimiser::bestOf(const Submesh& patch, Change& by) const {
  constexpr std::array kTrials = {Trial{Change::None},      Trial{Change::Remove, 0},       Trial{Change::Remove, 1},
                                  Trial{Change::Remove, 2}, Trial{Change::Insert, kCentre}, Trial{Change::Insert, 0},
                                  Trial{Change::Insert, 1}, Trial{Change::Insert, 2},       Trial{Change::Split, 0},
                                  Trial{Change::Split, 1},  Trial{Change::Split, 2}};
  std::optional<TriMesh> best;
  Optimiser as_it_is(patch, *this);
  double least = as_it_is.costOfAll() - kLeastGain;
  if (std::isinf(least)) return best;
  const double held = as_it_is.goalOfAll();
  // Computed when first needed.
  double known_shortest = std::numeric_limits<double>::quiet_NaN();
  const auto shortest = [&] {
    if (std::isnan(known_shortest)) known_shortest = std::min(kShort, as_it_is.shortestShare());
    return known_shortest;
  };
  // Shapes gain from some edges longer than requested, but the limit for the largest size applies.
  const double longest = std::max(kLongestShare * size_->most(), as_it_is.longestEdge());
  for (const Trial& trial : kTrials) {
    if (!as_it_is.isWorthTrying(trial)) continue;
    const bool grows = trial.change == Change::Insert || trial.change == Change::Split;
    if (grows && !isFreeToGrow()) continue;
    Optimiser other(patch, *this);
    if (!other.change(trial)) continue;
    const auto turn = [&](int times) {
      for (int k = 0; k < times; ++k) other.sweep(false, false, {}, 0.0, 1.0);
    };
    turn(kFirstTurns);
    if (other.costOfAll() > least + kHopeless) continue;
    turn((goal_ == QualityGoal::Shape ? kTurns : kTurnsForGoals) - kFirstTurns);
    const double cost = other.costOfAll();
    if (!(cost < least) || other.goalOfAll() < held || other.shortestShare() < shortest()) continue;
    if (other.longestEdge() > longest) continue;
    TriMesh solved = other.release();
    if (wouldFlip(patch, solved)) continue;
    least = cost;
    by = trial.change;
    best = std::move(solved);
  }
  return best;
}

// Replaces a patch by its solution.
void Optimiser::takePatch(const Submesh& patch, const TriMesh& solved) {
  std::vector<VertexId> added;
  touched_.clear();
  putBack(mesh_, patch, solved, added, touched_);
  const auto isOnShore = [&](VertexId v) { return mesh_.kind(v) != VertexKind::Free; };
  for (const VertexId v : added) noteAdded(v);
  // Lengths on shores follow their edges, which have changed.
  for (const TriId t : touched_)
    for (const VertexId v : mesh_.triangle(t).v)
      if (isOnShore(v)) wanted_[v] = wantedAt(v);
  for (const VertexId v : added)
    if (!isOnShore(v)) wanted_[v] = wantedAt(v);
  wake();
}

// Returns whether the mesh has changed.
bool Optimiser::mendPlace(TriId t, unsigned rings, BestOfPatch best_of) {
  const Submesh patch = extractAround(mesh_, {}, {&t, 1}, rings, patch_numbers_);
  if (isHeldByFrozen(patch)) {
    if (is_submesh_) waiting_.insert(waiting_.end(), mesh_.triangle(t).v.begin(), mesh_.triangle(t).v.end());
    return false;
  }
  Change by = Change::None;
  const std::optional<TriMesh> best = (this->*best_of)(patch, by);
  if (!best) return false;
  takePatch(patch, *best);
  stats_.removals += by == Change::Remove || by == Change::RemoveShort;
  stats_.segment_splits += by == Change::Split;
  ++stats_.relocations;
  return true;
}

// Improves triangles that are still poor, the poorest first, by what single moves cannot do: moving several vertices of
// a patch, removing one, or inserting one.
void Optimiser::mendPoorest(const RunControl& control, double share) {
  std::deque<PoorTriangle> poor;
  const auto add = [&](TriId t) {
    const Corners& v = mesh_.triangle(t).v;
    if (std::ranges::none_of(v, [this](VertexId w) { return isDue(w); })) return;
    if (const double shape = shapeOfTriangle(t); shape < kPoorShape) poor.push_back({shape, t, v});
  };
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t)
    if (mesh_.isLive(t)) add(t);
  std::ranges::sort(poor, {}, [](const PoorTriangle& p) { return std::pair(p.shape, p.triangle); });
  const double triangles = mesh_.triangleSlots();
  double left = (goal_ == QualityGoal::Shape ? kFirstPatches : kFirstForGoals) * triangles;
  double most = kMostPatches * triangles;
  while (left >= 1.0 && most >= 1.0 && !poor.empty()) {
    control.checkpoint(share);
    const PoorTriangle next = poor.front();
    poor.pop_front();
    if (!mesh_.isLive(next.triangle) || mesh_.triangle(next.triangle).v != next.corners) continue;
    --left;
    --most;
    if (!mendPlace(next.triangle, kRings, &Optimiser::bestOf)) continue;
    left += kMoreForGain;
    for (const TriId t : touched_)
      if (mesh_.isLive(t)) add(t);
  }
}

}  // namespace coastmesh
