#include "core/refine/optimise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/exchange_diagonal.hpp"
#include "core/refine/triangle_cost.hpp"
#include "core/refine/vertex_ops.hpp"

namespace coastmesh {

namespace {

// Edges shorter than this share of what is wanted have their ends merged.
constexpr double kShortest = 0.7;
// A move that breaks a bound or costs more is tried at half the way, and at a quarter.
constexpr int kAttempts = 3;
// Moves by less than this share of the length wanted are not worth it.
constexpr double kStill = 0.01;
// Vertices rest for so many sweeps before their numbers of neighbours count, and for so many at the end.
constexpr int kFirstBalance = 2, kSettle = 3;
// Triangles of a shape below this are mended for themselves in the second half of the sweeps, as long as they gain so
// much and their star costs no more than a little more.
constexpr double kPoorShape = 0.9, kLeastGain = 0.002, kMostCost = 1.005;

class Optimiser {
 public:
  Optimiser(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options)
      : size_(options.size),
        goal_(options.goal),
        bound_(strictBoundOf(options)),
        mesh_(std::move(mesh)),
        ops_(mesh_, pslg, bound_),
        exchange_(mesh_, ops_, bound_, wanted_),
        flips_may_harm_(bound_.max_angle < std::numbers::pi || !std::isinf(bound_.squared_size)),
        wanted_(mesh_.vertexSlots(), 0.0) {
    ops_.keepBadInPlace();
    for (VertexId v = 0; v < mesh_.vertexSlots(); ++v)
      if (mesh_.isLiveVertex(v)) wanted_[v] = wantedAt(v);
    for (TriId t = 0; t < mesh_.triangleSlots() && !any_bad_; ++t)
      any_bad_ = isBad(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), bound_);
  }

  Optimiser(MeshState&& state, const Pslg& pslg, const RefineOptions& options)
      : Optimiser(std::move(state.mesh), pslg, options) {
    ops_.keepClearOfFrozen();
    is_submesh_ = true;
    due_ = std::move(state.due_vertices);
  }

  void run(int sweeps, const RunControl& control) {
    std::uint64_t steps = 0;
    active_.assign(mesh_.vertexSlots(), 1);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      mends_poor_ = sweep >= sweeps / 2;
      if (sweep == sweeps / 2) active_.assign(mesh_.vertexSlots(), 1);
      const bool merges = sweep + 1 < sweeps;  // after a merge the vertices round it have to move
      const bool balances = sweep >= kFirstBalance && sweep + kSettle < sweeps;
      for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); ++v) {
        if (++steps % 1024 == 0) control.checkpoint((sweep + static_cast<double>(v) / mesh_.vertexSlots()) / sweeps);
        if (!active_[v] || !mesh_.isLiveVertex(v) || !isDue(v) || mesh_.kind(v) != VertexKind::Free) continue;
        active_[v] = 0;
        if (!gatherRing(v) || (merges && mergeShort(v))) continue;
        const bool moved = move(v);
        if (balances && (!moved || gatherRing(v))) balance(v);
      }
    }
  }

  TriMesh release() { return mesh_.release(); }
  MeshState releaseState() { return releaseDue(mesh_, std::move(due_)); }
  RefineStats& stats() { return stats_; }

 private:
  bool isDue(VertexId v) const { return due_.empty() || due_[v]; }

  // The triangles round a free vertex; false where a frozen edge is opposite, or there are too many.
  bool gatherRing(VertexId v) {
    constexpr std::size_t kMost = 64;
    if (mesh_.ring(v, mesh_.triangleOf(v), kMost, ring_) != StarKind::Closed) return false;
    frame_ = Frame(bound_.surface, mesh_.point(v));
    if (frame_.isCurved()) {
      seen_.clear();
      for (const VertexId w : ring_.corners) seen_.push_back(frame_.to(mesh_.point(w)));
    }
    const auto isFrozen = [&](TriId t) { return mesh_.segment(edgeRef(t, mesh_.cornerOf(t, v))) == kFrozen; };
    return !is_submesh_ || std::ranges::none_of(ring_.triangles, isFrozen);
  }

  double wantedAt(VertexId v);
  double costRound(const Point& place, double wanted, double limit) const;
  double costHere(VertexId v, Point& centre) const;
  double goalAt(VertexId v, const Point& place) const;
  std::optional<Point> placeForGoal(VertexId v, double cost) const;
  double leastShape(const Point& place, std::size_t& at) const;
  std::optional<Point> betterPlace(VertexId v) const;
  bool flipsAt(VertexId v, const Point& place) const;
  bool move(VertexId v);
  bool mergeShort(VertexId v);
  bool mergeInto(VertexId v, VertexId stays);
  int excess(VertexId v);
  int imbalanceAdded(VertexId v, int more);
  void balance(VertexId v);
  void mergeTooFew(VertexId v);
  void exchangeTooMany(VertexId v);
  void wake();

  const Point& corner(std::size_t i) const {
    return mesh_.point(ring_.corners[i < ring_.corners.size() ? i : i - ring_.corners.size()]);
  }
  // The same in the frame.
  const Point& seen(std::size_t i) const {
    return frame_.isCurved() ? seen_[i < seen_.size() ? i : i - seen_.size()] : corner(i);
  }
  double squaredLengthOf(VertexId v, VertexId w) const {
    return bound_.surface.squaredChord(mesh_.point(v), mesh_.point(w));
  }
  double wantedOf(std::size_t i) const {
    return wanted_[ring_.corners[i < ring_.corners.size() ? i : i - ring_.corners.size()]];
  }

  const SizeFunction* size_;  // may be null
  QualityGoal goal_;
  TriangleBound bound_;
  EditMesh mesh_;
  VertexOps ops_;
  DiagonalExchange exchange_;
  bool flips_may_harm_;  // they keep the smallest angle, but not the largest, nor the longest edge
  bool is_submesh_ = false;
  bool any_bad_ = false;  // whether there is a triangle, excused by the input, that nothing may change
  bool mends_poor_ = false;
  RefineStats stats_;
  std::vector<double> wanted_;        // one a vertex: the length wanted there
  std::vector<std::uint8_t> active_;  // one a vertex: whether anything changed round it since its last turn
  std::vector<std::uint8_t> due_;     // one a vertex; empty where all are

  // Scratch.
  Ring ring_;  // of the vertex whose turn it is
  // Where that vertex lay when the ring was gathered: in this frame places are moved and costs are reckoned.
  Frame frame_{{}, {}};
  std::vector<Point> seen_;  // the ring's corners in the frame, on a sphere
  std::vector<EdgeRef> star_;
  std::vector<TriId> touched_;
};

// The length wanted at a vertex. On a shore that is finer no more than its edges have, where no size is given the mean
// of its edges.
double Optimiser::wantedAt(VertexId v) {
  const double wanted = size_ == nullptr ? std::numeric_limits<double>::infinity() : size_->at(mesh_.point(v));
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

// What the triangles round a vertex cost where it lies at `place` of the frame; infinite where a bound is broken or
// more than `limit` is due.
double Optimiser::costRound(const Point& place, double wanted, double limit) const {
  constexpr double kTooMuch = std::numeric_limits<double>::infinity();
  const bool curved = frame_.isCurved();
  const Point in_plane = frame_.from(place);
  double sum = 0.0;
  Point a = mesh_.point(ring_.corners.front());
  double size = wanted_[ring_.corners.front()];
  for (std::size_t i = 0; i < ring_.corners.size(); ++i) {
    const Point& b = corner(i + 1);
    const double next = wantedOf(i + 1), mean = (wanted + size + next) / 3.0;
    if (orient2d(a, b, in_plane) <= 0 || isBad(a, b, in_plane, bound_)) return kTooMuch;
    sum += curved ? costOf(seen(i), seen(i + 1), place, mean) : costOf(a, b, place, mean);
    if (sum > limit) return kTooMuch;
    a = b;
    size = next;
  }
  return sum;
}

// What the triangles round a vertex cost, and the mean of their centroids in the frame, each weighted by how many
// triangles of the size wanted its own is worth.
double Optimiser::costHere(VertexId v, Point& centre) const {
  const Point here = frame_.to(mesh_.point(v));
  Point mean, a = seen(0);
  double sum = 0.0, weight = 0.0, size = wanted_[ring_.corners.front()];
  bool breaks = false;
  for (std::size_t i = 0; i < ring_.corners.size(); ++i) {
    const Point& b = seen(i + 1);
    const double next = wantedOf(i + 1), wanted = (wanted_[v] + size + next) / 3.0;
    breaks = breaks || isBad(corner(i), corner(i + 1), mesh_.point(v), bound_);
    sum += costOf(a, b, here, wanted);
    const double own = cross(a - here, b - here) / (wanted * wanted);
    mean = mean + own * (a - here + (b - here));
    weight += own;
    a = b;
    size = next;
  }
  centre = here + (1.0 / (3.0 * weight)) * mean;
  return breaks ? std::numeric_limits<double>::infinity() : sum;
}

double Optimiser::leastShape(const Point& place, std::size_t& at) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring_.corners.size(); ++i) {
    const double shape = shapeOf(seen(i), seen(i + 1), place);
    if (shape < least) {
      least = shape;
      at = i;
    }
  }
  return least;
}

// The least of what the goal asks round a vertex at `place`, over what is enough: 1 where nothing is left to do.
// REQUIRES: every triangle of the star is counter-clockwise there.
double Optimiser::goalAt(VertexId v, const Point& place) const {
  constexpr double kEnoughCentred = 0.035;  // the cotangent of 88 degrees
  const double enough_link = goal_ == QualityGoal::Links ? 0.22 : 0.12;
  double least = 1.0;
  for (std::size_t i = 0; i < ring_.corners.size(); ++i) {
    const Point &a = seen(i), &b = seen(i + 1), &c = seen(i + 2);
    if (goal_ == QualityGoal::Centred) {
      least = std::min(least, centrednessOf(place, a, b) / kEnoughCentred);
      continue;
    }
    least = std::min(least, linkShareOf(place, b, c, a) / enough_link);
    const EdgeRef beyond = mesh_.twin(edgeRef(ring_.triangles[i], mesh_.cornerOf(ring_.triangles[i], v)));
    if (beyond == kNone) continue;
    least = std::min(least, linkShareOf(a, b, place, frame_.to(mesh_.point(mesh_.apex(beyond)))) / enough_link);
  }
  return least;
}

// The best of some places of the frame round a vertex for what the goal asks, where its star costs little more.
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
      if (!(costRound(to, wanted_[v], kMostGoalCost * cost) < kMostGoalCost * cost)) continue;
      const double then = goalAt(v, to);
      if (then <= best) continue;
      best = then;
      place = to;
    }
    if (place) return place;
  }
  return std::nullopt;
}

// Where in the frame the star of a vertex costs less or, later on, its poorest triangle gains and the others lose next
// to nothing.
std::optional<Point> Optimiser::betterPlace(VertexId v) const {
  const Point here = frame_.to(mesh_.point(v));
  Point to;
  const double cost = costHere(v, to);
  if (!std::isfinite(to.x) || !std::isfinite(to.y)) return std::nullopt;
  const double held = mends_poor_ ? goalAt(v, here) : 1.0;
  if (held < 1.0)
    if (const std::optional<Point> place = placeForGoal(v, cost)) return place;
  const auto keepsGoal = [&](const Point& place) { return !mends_poor_ || goalAt(v, place) >= held; };
  const double still = kStill * wanted_[v];
  for (int attempt = 0; attempt < kAttempts && squaredDistance(here, to) >= still * still; ++attempt) {
    if (costRound(to, wanted_[v], cost) < cost && keepsGoal(to)) return to;
    to = midpoint(here, to);
  }
  if (!mends_poor_) return std::nullopt;
  std::size_t poorest = 0, any = 0;
  const double shape = leastShape(here, poorest);
  if (shape > kPoorShape) return std::nullopt;
  const Point &a = seen(poorest), &b = seen(poorest + 1);
  const Point apex =
      midpoint(a, b) + 0.5 * kRootOfThree * Point{a.y - b.y, b.x - a.x};  // of the equilateral triangle there
  double share = 0.4;
  for (int attempt = 0; attempt < kAttempts; ++attempt, share *= 0.5) {
    to = here + share * (apex - here);
    if (leastShape(to, any) > shape + kLeastGain && costRound(to, wanted_[v], kMostCost * cost) < kMostCost * cost &&
        keepsGoal(to))
      return to;
  }
  return std::nullopt;
}

// Whether the Delaunay property would ask for flips round a vertex at `place`.
bool Optimiser::flipsAt(VertexId v, const Point& place) const {
  for (std::size_t i = 0; i < ring_.corners.size(); ++i) {
    const TriId t = ring_.triangles[i];
    const EdgeRef opposite = edgeRef(t, mesh_.cornerOf(t, v));
    if (inCircle(place, corner(i), corner(i + 1), corner(i + 2)) > 0) return true;
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
  mesh_.setPoint(v, to);
  if (size_ != nullptr) wanted_[v] = size_->at(to);
  touched_.assign(ring_.triangles.begin(), ring_.triangles.end());
  mesh_.restoreDelaunayRound(v, touched_);
  ++stats_.relocations;
  wake();
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

// How many triangles there are round a vertex beyond six, or on the boundary beyond one for each 60 degrees.
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

// What so many more triangles round a vertex add to the square of its excess.
int Optimiser::imbalanceAdded(VertexId v, int more) { return more * (2 * excess(v) + more); }

// Mends the numbers of neighbours at a vertex, which ring_ is of.
void Optimiser::balance(VertexId v) {
  if (ring_.corners.size() < 6)
    mergeTooFew(v);
  else if (ring_.corners.size() > 6)
    exchangeTooMany(v);
}

// Merges a vertex with the neighbour that leaves numbers nearest to what they should be, if that is nearer than they
// are.
void Optimiser::mergeTooFew(VertexId v) {
  const std::vector<VertexId>& corners = ring_.corners;
  const int count = static_cast<int>(corners.size());
  const int own = (count - 6) * (count - 6);
  int best = 0;
  VertexId with = kNone;
  for (int i = 0; i < count; ++i) {
    const VertexId w = corners[i];
    if (mesh_.kind(w) == VertexKind::Input || !isDue(w)) continue;
    const double longest = 0.5 * (wanted_[v] + wanted_[w]);
    if (squaredLengthOf(v, w) > longest * longest) continue;
    const int added = imbalanceAdded(w, count - 4) - own + imbalanceAdded(corners[(i + 1) % count], -1) +
                      imbalanceAdded(corners[(i + count - 1) % count], -1);
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
  const int own = imbalanceAdded(v, -1);
  for (std::size_t i = 0; i < count; ++i) {
    const VertexId w = corners[i], left = corners[(i + 1) % count], right = corners[(i + count - 1) % count];
    if (!isOurs(w) || !isOurs(left) || !isOurs(right)) continue;
    if (own + imbalanceAdded(w, -1) + imbalanceAdded(left, 1) + imbalanceAdded(right, 1) >= 0) continue;
    touched_.clear();
    if (!exchange_.tryExchange(v, w, left, right, touched_)) continue;
    for (const VertexId u : {v, w, left, right}) {
      if (size_ != nullptr) wanted_[u] = size_->at(mesh_.point(u));
      ++stats_.relocations;
    }
    wake();
    return;
  }
}

// Everything round what changed gets another turn.
void Optimiser::wake() {
  for (const TriId t : touched_)
    if (mesh_.isLive(t))
      for (const VertexId w : mesh_.triangle(t).v) active_[w] = 1;
}

}  // namespace

RefineStats optimiseSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, int sweeps,
                            const RunControl& control) {
  Optimiser optimiser(std::move(state), pslg, options);
  optimiser.run(sweeps, control);
  state = optimiser.releaseState();
  return std::move(optimiser.stats());
}

RefineStats optimise(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, int sweeps,
                     const RunControl& control) {
  requireInRange(options);
  Optimiser optimiser(std::move(mesh), pslg, options);
  optimiser.run(sweeps, control);
  mesh = optimiser.release();
  labelRegions(mesh, pslg);
  RefineStats stats = std::move(optimiser.stats());
  stats.unresolved = findBoundViolations(mesh, options);
  return stats;
}

}  // namespace coastmesh
