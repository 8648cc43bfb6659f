#include "core/refine/refiner.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// No free vertex comes nearer to others than this share of the input's spacing there. Runs that reach their bound stay
// above: up to 42° all but single points, which repair can do without. Above that no spacing is fine enough, and a
// coarser one ends sooner.
double freeShare(double min_angle_deg) {
  const double beyond = std::clamp((min_angle_deg - 42.0) / 2.0, 0.0, 1.0);
  return 0.12 + 0.18 * beyond;
}
// New points aim above the bound where it is large: a mesh without any slack refines further. Algorithm 1 is the
// paper's.
double aimAboveDeg(double min_angle_deg) { return std::clamp(0.5 * (min_angle_deg - 38.0), 0.0, 1.0); }
// Relocations never bring a vertex more often than this: a bound on the run, not a setting.
constexpr std::uint8_t kMostMoves = 32;
// From this angle on taking vertices out during refinement pays: density spreads there.
constexpr double kMergeFromDeg = 35.0;

// Ranks of bad triangles: squared lengths in sixteen steps an octave, cosines in steps of a thousandth. Within a step
// the older comes first, which is near the one before it: an exact order costs time and gains no points.
std::uint32_t rankOfLength(double squared) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(squared) >> 48);
}
std::uint32_t rankOfAngle(double cosine) { return static_cast<std::uint32_t>((1.0 - cosine) * 1000.0); }

}  // namespace

RefineVariant usualVariant(const RefineOptions& options) {
  RefineVariant variant;
  if (options.algorithm == Algorithm::Relocate) variant.aim_deg = aimAboveDeg(options.min_angle_deg);
  variant.free_share = freeShare(options.min_angle_deg);
  return variant;
}

Refiner::Refiner(TriMesh&& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes&& notes,
                 const RefineVariant& variant)
    : pslg_(pslg),
      options_(options),
      variant_(variant),
      bound_(boundOf(options)),
      strict_(strictBoundOf(options)),
      mesh_(std::move(mesh)),
      search_(options.algorithm, bound_, toRadians(variant.aim_deg), options.size_scale),
      ops_(mesh_, pslg_, bound_),
      cos_lens_(-std::cos(2.0 * bound_.min_angle)),
      squared_resolution_(squaredResolution()),
      notes_(std::move(notes)),
      moves_(mesh_.vertexSlots(), 0) {
  if (variant_.clear_of_frozen) findFrozenVertices();
}

void Refiner::findFrozenVertices() {
  ops_.keepClearOfFrozen();
  frozen_.assign(mesh_.inputVertices(), false);
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh_.segment(edgeRef(t, i)) == kFrozen)
        frozen_[mesh_.origin(edgeRef(t, i))] = frozen_[mesh_.target(edgeRef(t, i))] = true;
}

// Whether a patch is next to a frozen edge, and is to be left alone for that.
bool Refiner::isBarred(const Patch& patch) const {
  return variant_.clear_of_frozen &&
         std::ranges::any_of(patch.boundary, [](const BoundaryEdge& r) { return r.seg == kFrozen; });
}

// A thousand units in the last place of the largest coordinate, or what was asked for, squared.
double Refiner::squaredResolution() const {
  double magnitude = 0.0;
  for (VertexId v = 0; v < mesh_.vertexSlots(); ++v)
    magnitude = std::max({magnitude, std::abs(mesh_.point(v).x), std::abs(mesh_.point(v).y)});
  const double resolution = std::max(options_.resolution, 1000.0 * std::numeric_limits<double>::epsilon() * magnitude);
  return resolution * resolution;
}

void Refiner::enqueueIfBad(TriId t) {
  const Triangle& tri = mesh_.triangle(t);
  const Point &a = mesh_.point(tri.v[0]), &b = mesh_.point(tri.v[1]), &c = mesh_.point(tri.v[2]);
  if (!isBad(a, b, c, bound_)) return;
  const TriangleShape shape(a, b, c);
  // Shortest edge first; the worst angle first for circumcentres (Erten & Üngör 2007, Section 2.1).
  const bool worst_first = variant_.worst_first || options_.algorithm == Algorithm::Circumcenter;
  queue_.push(worst_first ? rankOfAngle(shape.cosAt(shape.shortest)) : rankOfLength(shape.squared[shape.shortest]),
              {t, tri.v});
}

void Refiner::enqueueTouched() {
  for (const TriId t : touched_)
    if (mesh_.isLive(t)) enqueueIfBad(t);
  touched_.clear();
}

void Refiner::run(const RunControl& control) {
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t)
    if (mesh_.isLive(t)) enqueueIfBad(t);
  drainQueue(control);
}

void Refiner::resume(std::vector<TriId>& touched, const RunControl& control) {
  touched_.swap(touched);
  enqueueTouched();
  drainQueue(control);
}

void Refiner::drainQueue(const RunControl& control) {
  std::uint64_t steps = 0;
  while (!queue_.empty()) {
    if (++steps % 1024 == 0)
      control.checkpoint(static_cast<double>(steps) / static_cast<double>(steps + queue_.size()));
    if (mesh_.vertexCount() >= options_.max_vertices) {
      stats_.budget_reached = true;
      return;
    }
    const BadTriangle bad = queue_.pop();
    if (mesh_.vertexCount() > options_.most_in_memory) throw OutOfRoom(mesh_.point(bad.corners[0]));
    if (mesh_.triangle(bad.triangle).v == bad.corners) mend(bad.triangle);
  }
}

void Refiner::mend(TriId t) {
  const TriangleShape shape(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2));
  if (!isBad(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), bound_)) return;
  const auto isFrozen = [this](VertexId v) { return v < frozen_.size() && frozen_[v]; };
  if (std::ranges::any_of(mesh_.triangle(t).v, isFrozen)) return defer(t);
  if (isLeftAlone(t, shape)) return;
  // No move brings edges to the length wanted where there are too few.
  const bool is_only_long =
      options_.size != nullptr && !isBad(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), strict_);
  if (options_.algorithm == Algorithm::Relocate && !is_only_long && mendWithoutInsertion(t)) {
    enqueueTouched();
    return;
  }
  if (!isOutOfReach(t, shape)) insertPoint(t, shape.shortest);
}

// Whether every place where a vertex would make a good triangle with the shortest edge is nearer to that edge than the
// input's spacing lets any vertex come: between two segments that meet at a tiny angle.
bool Refiner::isOutOfReach(TriId t, const TriangleShape& shape) const {
  const double longest = shape.squared[shape.longest];
  if (isTooLong(mesh_.corner(t, 0), mesh_.corner(t, 1), mesh_.corner(t, 2), longest, bound_)) return false;
  const auto& v = mesh_.triangle(t).v;
  const double spacing = std::min(notes_.spacing[v[next3(shape.shortest)]], notes_.spacing[v[prev3(shape.shortest)]]);
  // The petal's diameter is the edge over the sine.
  const double nearest = kSegmentShare * spacing * bound_.sin_min;
  return shape.squared[shape.shortest] < nearest * nearest;
}

// A triangle that fills a sector too small for the bounds, its smallest angle there, cannot be mended.
bool Refiner::isLeftAlone(TriId t, const TriangleShape& shape) const {
  return isFan(t, mesh_.triangle(t).v[shape.shortest]);
}

bool Refiner::isFan(TriId t, VertexId apex) const {
  if (apex >= mesh_.inputVertices() || !notes_.small_angle[apex]) return false;
  const unsigned i = mesh_.cornerOf(t, apex);
  if (!mesh_.isConstrained(edgeRef(t, next3(i))) || !mesh_.isConstrained(edgeRef(t, prev3(i)))) return false;
  const Triangle& tri = mesh_.triangle(t);
  return !bound_.canDivide(angleAt(mesh_.point(apex), mesh_.point(tri.v[next3(i)]), mesh_.point(tri.v[prev3(i)])));
}

// The apex of the small input angle whose fan lies behind the shortest edge of t; kNone where there is none.
VertexId Refiner::fanApexBehind(TriId t, unsigned apex) const {
  const EdgeRef shortest = edgeRef(t, apex);
  if (mesh_.isConstrained(shortest)) return kNone;
  const EdgeRef beyond = mesh_.twin(shortest);
  const VertexId v = mesh_.apex(beyond);
  return isFan(triOf(beyond), v) ? v : kNone;
}

// Two vertices merged may come to be two again: merges are bounded by what was put in, and by the mesh's size, lest
// both go on for ever.
bool Refiner::mayMerge() const {
  const auto& types = stats_.by_type;
  const std::uint64_t put_in = types[0] + types[1] + types[2] + types[3] + stats_.segment_splits;
  return 10 * stats_.merges < 3 * put_in && 2 * stats_.merges < mesh_.vertexCount();
}

// Algorithm 2: a vertex of the triangle that finds a place where its whole star is good moves there. We go on where the
// paper does not: one that is not needed goes, and two that one place can serve become one.
bool Refiner::mendWithoutInsertion(TriId t) {
  const Corners corners = mesh_.triangle(t).v;
  for (const VertexId v : corners) {
    if (mesh_.kind(v) == VertexKind::Input || moves_[v] >= kMostMoves || !ops_.relocate(v, touched_)) continue;
    ++moves_[v];
    ++stats_.relocations;
    return true;
  }
  if (bound_.min_angle < toRadians(kMergeFromDeg) || !mayMerge()) return false;
  for (const VertexId v : corners) {
    if (mesh_.kind(v) == VertexKind::Input || !ops_.mergeWithNeighbour(v, false, touched_)) continue;
    ++stats_.merges;
    return true;
  }
  return false;
}

// Whether x sees the subsegment under 180° - 2 alpha or more: the diametral lens of Chew (1993) and Shewchuk (1997) for
// 30°, wider with alpha. A triangle with such an angle is bad, so a subsegment that a vertex encroaches upon always has
// one.
bool Refiner::isEncroached(const Point& x, const Point& a, const Point& b) const {
  const double d = dot(a - x, b - x);
  if (d >= 0.0) return false;
  if (cos_lens_ >= 0.0) return true;
  return d * d >= cos_lens_ * cos_lens_ * squaredDistance(x, a) * squaredDistance(x, b);
}

// The local feature size of the input, from above: that of a vertex nearby and the distance to it. It grows with the
// distance from what is fine in the input as fast as any good mesh can.
double Refiner::spacingAt(const Point& x, const Patch& cavity) const {
  double spacing = bound_.size == nullptr ? options_.size_max : bound_.size->at(x);
  for (const BoundaryEdge& r : cavity.boundary)
    spacing = std::min(spacing, notes_.spacing[r.a] + distance(x, mesh_.point(r.a)));
  return spacing;
}

void Refiner::noteVertex(VertexId v, double spacing) {
  notes_.spacing.resize(mesh_.vertexSlots());
  moves_.resize(mesh_.vertexSlots());
  notes_.spacing[v] = spacing;
  moves_[v] = 0;
}

bool Refiner::insertPoint(TriId t, unsigned apex) {
  const SteinerPoint candidate = search_.find(mesh_, t, apex);
  if (!std::isfinite(candidate.place.x) || !std::isfinite(candidate.place.y)) return false;
  const EditMesh::Place where = mesh_.locate(candidate.place, candidate.near);
  if (where.blocked != kNone) return splitFor(where.blocked, t, apex);
  if (where.triangle == kNone) return false;
  const bool inside = mesh_.findCavity(candidate.place, where.triangle, patch_);
  if (isBarred(patch_)) {
    defer(t);
    return false;
  }
  EdgeRef hit = kNone;
  double widest = 0.0;
  for (const BoundaryEdge& r : patch_.boundary) {
    if (r.seg == kNone && r.beyond != kNone) continue;
    const Point &a = mesh_.point(r.a), &b = mesh_.point(r.b);
    const bool behind = orient2d(a, b, candidate.place) <= 0;
    if (!behind && (r.seg == kFrozen || !isEncroached(candidate.place, a, b))) continue;
    const double angle = behind ? std::numbers::pi : angleAt(candidate.place, a, b);
    if (angle <= widest) continue;
    widest = angle;
    // The edge as the cavity has it.
    for (const TriId c : patch_.triangles)
      for (unsigned i = 0; i < 3; ++i)
        if (mesh_.origin(edgeRef(c, i)) == r.a && mesh_.target(edgeRef(c, i)) == r.b) hit = edgeRef(c, i);
  }
  if (hit != kNone) return splitFor(hit, t, apex);
  const double spacing = spacingAt(candidate.place, patch_);
  if (!inside || std::min(candidate.squared_clearance, spacing * spacing) < squared_resolution_) return false;
  if (candidate.squared_clearance < variant_.free_share * variant_.free_share * spacing * spacing) return false;
  const VertexId fan = fanApexBehind(t, apex);
  if (fan != kNone)
    for (const TriId c : patch_.triangles)
      if (isFan(c, fan)) return false;

  const VertexId v = mesh_.insertInCavity(candidate.place, patch_, touched_);
  noteVertex(v, spacing);
  ++stats_.by_type[static_cast<unsigned>(candidate.type)];
  enqueueTouched();
  return true;
}

bool Refiner::removeFreeVertex(VertexId v) {
  if (!mesh_.gatherPatch({&v, 1}, patch_) || isBarred(patch_)) return false;
  polygon_.clear();
  for (const BoundaryEdge& r : patch_.boundary) polygon_.push_back(r.a);
  if (!triangulatePolygon(mesh_, polygon_, fresh_)) return false;
  mesh_.replace(patch_, fresh_, {&v, 1}, touched_);
  mesh_.restoreDelaunay(touched_);
  return true;
}

void Refiner::stripFreeVertices() {
  for (VertexId v = mesh_.inputVertices(); v < mesh_.vertexSlots(); ++v)
    if (mesh_.isLiveVertex(v) && mesh_.kind(v) == VertexKind::Free) removeFreeVertex(v);
  touched_.clear();
}

bool Refiner::violatesBound(TriId t) const {
  const Point &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
  return isBad(a, b, c, strict_) && (notes_.corners == nullptr || notes_.corners->excuseOf(a, b, c) == Excuse::None);
}

bool Refiner::isDeferred(TriId t) const {
  const auto entry = deferred_.find(t);
  return entry != deferred_.end() && entry->second == mesh_.triangle(t).v;
}

TriMesh Refiner::release() {
  stats_.steiner_points = mesh_.vertexCount() - mesh_.inputVertices();
  return mesh_.release();
}

TriMesh Refiner::release(VertexNotes& notes, std::vector<std::uint8_t>& due) {
  std::erase_if(deferred_, [this](const auto& entry) { return !isDeferred(entry.first); });
  Renumbering by;
  stats_.steiner_points = mesh_.vertexCount() - mesh_.inputVertices();
  TriMesh mesh = mesh_.release(by, false);
  due.assign(mesh.triangles.size(), 0);
  for (const auto& [t, corners] : deferred_) due[by.triangle[t]] = 1;
  notes = std::move(notes_);
  std::vector<double> spacing(mesh.points.size());
  for (VertexId v = 0; v < by.vertex.size(); ++v)
    if (by.vertex[v] != kNone) spacing[by.vertex[v]] = notes.spacing[v];
  notes.spacing = std::move(spacing);
  return mesh;
}

}  // namespace coastmesh
