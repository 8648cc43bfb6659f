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

// Layers of triangles around an edge in each pass: small patches repair most edges at less cost.
constexpr std::array kRings = {2U, 3U, 2U, 4U};
// Sweeps over a patch without bounds on angles, and with them. Most vertices to add where triangles still miss the
// bounds.
constexpr int kTurns = 5, kTurnsWithin = 2, kMostAdded = 6;
// Weight of the shortness of edges, in shares of the least length, against the cost of triangles. A patch is used if it
// gains kLeastGain of shortness.
constexpr double kShortWeight = 10.0, kLeastGain = 0.01;
// Shortness below this share of the least length has this additional weight.
constexpr double kFarTooShort = 0.8, kSevere = 10.0;
// Most patches in a pass: for each short edge, and as a share of the triangles.
constexpr double kMostForEdge = 3.0, kMostPatches = 0.1;

}  // namespace

double Optimiser::lengthOf(EdgeRef e) const {
  return bound_.surface.chord(mesh_.point(mesh_.origin(e)), mesh_.point(mesh_.target(e)));
}

// True if an edge is shorter than the least length, unless the input requires it.
bool Optimiser::isShort(EdgeRef e) const {
  const auto isGiven = [&](VertexId v) { return mesh_.kind(v) == VertexKind::Input; };
  if (mesh_.isConstrained(e) && isGiven(mesh_.origin(e)) && isGiven(mesh_.target(e))) return false;
  return lengthOf(e) < options_.least_edge;
}

Optimiser::Shortness Optimiser::shortness() const {
  Shortness all{0.0, std::numeric_limits<double>::infinity()};
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t) {
    for (unsigned i = 0; i < 3 && mesh_.isLive(t); ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (const EdgeRef twin = mesh_.twin(e); twin != kNone && twin < e) continue;
      const double length = lengthOf(e);
      const double share = length / options_.least_edge;
      all.sum += std::max(0.0, 1.0 - share) + kSevere * std::max(0.0, kFarTooShort - share);
      all.shortest = std::min(all.shortest, length);
    }
  }
  return all;
}

// Removes the ends of short edges, except input vertices, from a patch. Returns whether any was removed.
bool Optimiser::takeOutShort() {
  std::vector<VertexId> out;
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t) {
    for (unsigned i = 0; i < 3 && mesh_.isLive(t); ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (!isShort(e)) continue;
      for (const VertexId v : {mesh_.origin(e), mesh_.target(e)})
        if (mesh_.kind(v) != VertexKind::Input) out.push_back(v);
    }
  }
  std::ranges::sort(out);
  out.erase(std::ranges::unique(out).begin(), out.end());
  bool any = false;
  for (const VertexId v : out) any = ops_.removeAnyway(v, touched_) || any;
  return any;
}

// Moves the vertices of a patch: by cost alone first, since the way to good triangles may lead past bad ones.
void Optimiser::settle() {
  const auto turn = [this](int times) {
    std::ranges::fill(active_, 1);
    for (int k = 0; k < times; ++k) sweep(false, false, {}, 0.0, 1.0);
  };
  const TriangleBound bound = bound_;
  const double clear_shape = std::exchange(clear_shape_, 0.0);
  const bool flips_may_harm = std::exchange(flips_may_harm_, false);
  bound_ = TriangleBound(0.0, 180.0, std::numeric_limits<double>::infinity());
  bound_.surface = bound.surface;
  turn(kTurns);
  bound_ = bound;
  clear_shape_ = clear_shape;
  flips_may_harm_ = flips_may_harm;
  turn(kTurnsWithin);
}

// Inserts a vertex in the middle of the longest edge of the poorest triangle of a patch that misses the bounds. Returns
// false if there is none, or its edge is frozen.
bool Optimiser::divideWorst() {
  double least = std::numeric_limits<double>::infinity();
  TriId worst = kNone;
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t) {
    if (!mesh_.isLive(t)) continue;
    const Corners& v = mesh_.triangle(t).v;
    if (!isBad(mesh_.point(v[0]), mesh_.point(v[1]), mesh_.point(v[2]), bound_)) continue;
    const double shape = shapeOfTriangle(t);
    if (shape >= least) continue;
    least = shape;
    worst = t;
  }
  if (worst == kNone) return false;
  EdgeRef longest = edgeRef(worst, 0);
  for (const unsigned i : {1U, 2U})
    if (lengthOf(edgeRef(worst, i)) > lengthOf(longest)) longest = edgeRef(worst, i);
  if (mesh_.segment(longest) == kFrozen) return false;
  if (mesh_.isConstrained(longest)) return halveSegment(longest);
  const Point middle = midpoint(mesh_.point(mesh_.origin(longest)), mesh_.point(mesh_.target(longest)));
  Patch cavity;
  if (!mesh_.findCavity(middle, worst, cavity)) return false;
  touched_.clear();
  noteAdded(mesh_.insertInCavity(middle, cavity, touched_));
  return true;
}

// The best result of moving a patch's vertices, removing one or all at short edges, and inserting others where bounds
// require it; nullopt if none is better.
std::optional<TriMesh> Optimiser::bestWithoutShort(const Submesh& patch, Change& by) const {
  constexpr std::array kTrials = {Trial{Change::Remove, 0}, Trial{Change::Remove, 1}, Trial{Change::Remove, 2},
                                  Trial{Change::None}, Trial{Change::RemoveShort}};
  std::optional<TriMesh> best;
  const Optimiser as_it_is(patch, *this);
  const double cost = as_it_is.costOfAll();
  if (std::isinf(cost)) return best;
  const Shortness before = as_it_is.shortness();
  const double held = as_it_is.goalOfAll();
  double least = kShortWeight * before.sum + cost;
  for (const Trial& trial : kTrials) {
    Optimiser other(patch, *this);
    if (!other.change(trial)) continue;
    other.settle();
    for (int k = 0; k < kMostAdded && isFreeToGrow() && other.divideWorst(); ++k) other.settle();
    const Shortness then = other.shortness();
    if (then.sum > before.sum - kLeastGain || then.shortest < std::min(before.shortest, options_.least_edge)) continue;
    const double total = kShortWeight * then.sum + other.costOfAll();
    if (!(total < least) || other.goalOfAll() < held) continue;
    TriMesh solved = other.release();
    if (wouldFlip(patch, solved)) continue;
    least = total;
    by = trial.change;
    best = std::move(solved);
  }
  return best;
}

// One pass, the shortest edges first, with patches of `rings` layers. Returns whether any may be left.
bool Optimiser::mendShort(const RunControl& control, double share, unsigned rings) {
  struct ShortEdge {
    double length;
    TriId triangle;
    Corners corners;
  };
  std::deque<ShortEdge> queue;
  const auto add = [&](TriId t) {
    const Corners& v = mesh_.triangle(t).v;
    if (std::ranges::none_of(v, [this](VertexId w) { return isDue(w); })) return;
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (const EdgeRef twin = mesh_.twin(e); twin != kNone && twin < e) continue;
      if (isShort(e)) queue.push_back({lengthOf(e), t, v});
    }
  };
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t)
    if (mesh_.isLive(t)) add(t);
  std::ranges::sort(queue, {}, [](const ShortEdge& e) { return std::pair(e.length, e.triangle); });
  double left = std::min(kMostForEdge * static_cast<double>(queue.size()), kMostPatches * mesh_.triangleSlots());
  while (left >= 1.0 && !queue.empty()) {
    control.checkpoint(share);
    const ShortEdge next = queue.front();
    queue.pop_front();
    if (!mesh_.isLive(next.triangle) || mesh_.triangle(next.triangle).v != next.corners) continue;
    --left;
    if (!mendPlace(next.triangle, rings, &Optimiser::bestWithoutShort)) continue;
    for (const TriId t : touched_)
      if (mesh_.isLive(t)) add(t);
  }
  for (TriId t = 0; t < mesh_.triangleSlots() && queue.empty(); ++t)
    if (mesh_.isLive(t)) add(t);
  return !queue.empty();
}

// Repairs edges shorter than the least length that moving and merging single vertices cannot.
void Optimiser::mendShortEdges(const RunControl& control, double share) {
  for (const unsigned rings : kRings)
    if (!mendShort(control, share, rings)) return;
}

}  // namespace coastmesh
