#include "core/refine/refine_run.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/hilbert.hpp"

namespace coastmesh {

namespace {

// Minimum distance of free vertices to others, as a share of the input's spacing there. Runs that reach their bound
// stay above it: up to 42° all but single points, which repair can do without. Beyond, no spacing is fine enough, and a
// coarser one ends sooner.
double freeShare(double min_angle_deg) {
  const double beyond = std::clamp((min_angle_deg - 42.0) / 2.0, 0.0, 1.0);
  return 0.12 + 0.18 * beyond;
}
// Degrees that new points aim above large bounds: a mesh without any slack causes further refinement. The gain grows
// towards 42°: a tenth of the vertices there, and most of the places that need repair. Beyond, where no aim makes
// refinement end by itself, it costs as much. Algorithm 1 stays as in the paper.
double aimAboveDeg(double min_angle_deg) {
  constexpr std::array<double, 5> kFrom{38.0, 40.0, 41.0, 42.0, 43.0}, kAim{0.0, 1.0, 2.0, 3.5, 1.0};
  if (min_angle_deg <= kFrom.front()) return kAim.front();
  for (std::size_t i = 1; i < kFrom.size(); ++i) {
    if (min_angle_deg > kFrom[i]) continue;
    const double share = (min_angle_deg - kFrom[i - 1]) / (kFrom[i] - kFrom[i - 1]);
    return kAim[i - 1] + share * (kAim[i] - kAim[i - 1]);
  }
  return kAim.back();
}
// Vertices of a block before refinement. Twice or half as many are as fast.
constexpr std::size_t kVerticesOfBlock = 4000;
constexpr std::size_t kMostBlocks = 512;

// Ranks of bad triangles: squared lengths in sixteen steps an octave, cosines in steps of a thousandth. Within a step
// the oldest comes first, which is near the previous one: an exact order costs time and saves no points. Some steps
// together are mended block by block: one step at a time throughout the mesh takes half as long again. More steps
// together take less time and more vertices, above all at large angles.
std::uint32_t rankOfLength(double squared, std::uint32_t steps_together, std::uint32_t block, std::uint32_t blocks) {
  const auto step = static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(squared) >> 48);
  return (step / steps_together * blocks + block) * steps_together + step % steps_together;
}
std::uint32_t stepsTogether(double min_angle_deg) { return min_angle_deg < 35.0 ? 16 : 8; }
std::uint32_t rankOfAngle(double cosine) { return static_cast<std::uint32_t>((1.0 - cosine) * 1000.0); }

// A thousand units in the last place of the largest coordinate, or the requested resolution if larger, squared.
double squaredResolution(const EditMesh& mesh, const RefineOptions& options) {
  double magnitude = 0.0;
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v)
    magnitude = std::max({magnitude, std::abs(mesh.point(v).x), std::abs(mesh.point(v).y)});
  const double resolution = std::max(options.resolution, 1000.0 * std::numeric_limits<double>::epsilon() * magnitude);
  return resolution * resolution;
}

void findFrozenVertices(RefineRun& run) {
  EditMesh& mesh = run.mesh;
  run.ops.keepClearOfFrozen();
  run.frozen.assign(mesh.inputVertices(), false);
  for (TriId t = 0; t < mesh.triangleSlots(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh.segment(edgeRef(t, i)) == kFrozen)
        run.frozen[mesh.origin(edgeRef(t, i))] = run.frozen[mesh.target(edgeRef(t, i))] = true;
}

// The published algorithms keep their order: by length or by angle alone.
bool mendsByBlocks(const RefineRun& run) {
  return run.options.algorithm == Algorithm::Relocate && !run.variant.worst_first;
}

}  // namespace

VertexBlocks::VertexBlocks(std::span<const Point> points, const Surface& surface)
    : count_(static_cast<std::uint32_t>(std::clamp(points.size() / kVerticesOfBlock, std::size_t{1}, kMostBlocks))) {
  if (count_ == 1) return;
  block_of_.resize(points.size());
  std::uint64_t before = 0;
  for (const VertexId v : hilbertOrder(points, surface))
    block_of_[v] = static_cast<std::uint16_t>(before++ * count_ / points.size());
}

RefineVariant usualVariant(const RefineOptions& options) {
  RefineVariant variant;
  if (options.algorithm == Algorithm::Relocate) variant.aim_deg = aimAboveDeg(options.min_angle_deg);
  variant.free_share = freeShare(options.min_angle_deg);
  return variant;
}

RefineRun::RefineRun(TriMesh&& unrefined, const Pslg& input, const RefineOptions& wanted, VertexNotes&& known,
                     const RefineVariant& how)
    : pslg(input),
      options(wanted),
      variant(how),
      bound(boundOf(options)),
      strict(strictBoundOf(options)),
      mesh(std::move(unrefined)),
      search(options.algorithm, bound, toRadians(variant.aim_deg), options.size_scale),
      ops(mesh, pslg, bound),
      cos_lens(-std::cos(2.0 * bound.min_angle)),
      squared_resolution(squaredResolution(mesh, options)),
      notes(std::move(known)),
      moves(mesh.vertexSlots(), 0),
      steps_together(stepsTogether(options.min_angle_deg)) {
  if (variant.clear_of_frozen) findFrozenVertices(*this);
  if (mendsByBlocks(*this)) blocks = VertexBlocks(mesh.points(), bound.surface);
}

bool violatesBound(const RefineRun& run, TriId t) {
  const EditMesh& mesh = run.mesh;
  const Point &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
  return isBad(a, b, c, run.strict) &&
         (run.notes.corners == nullptr || run.notes.corners->excuseOf(a, b, c) == Excuse::None);
}

bool isBarred(const RefineRun& run, const Patch& patch) {
  return run.variant.clear_of_frozen &&
         std::ranges::any_of(patch.boundary, [](const BoundaryEdge& r) { return r.seg == kFrozen; });
}

bool isDeferred(const RefineRun& run, TriId t) {
  const auto entry = run.deferred.find(t);
  return entry != run.deferred.end() && entry->second == run.mesh.triangle(t).v;
}

double spacingAt(const RefineRun& run, const Point& x, const Patch& cavity) {
  double spacing = run.bound.size == nullptr ? run.options.size_max : run.bound.size->at(x);
  for (const BoundaryEdge& r : cavity.boundary)
    spacing = std::min(spacing, run.notes.spacing[r.a] + run.bound.surface.chord(x, run.mesh.point(r.a)));
  return spacing;
}

void noteVertex(RefineRun& run, VertexId v, double spacing, VertexId beside) {
  run.notes.spacing.resize(run.mesh.vertexSlots());
  run.moves.resize(run.mesh.vertexSlots());
  run.notes.spacing[v] = spacing;
  run.moves[v] = 0;
  run.blocks.put(v, beside);
}

void enqueueIfBad(RefineRun& run, TriId t) {
  EditMesh& mesh = run.mesh;
  const Triangle& tri = mesh.triangle(t);
  const Point &a = mesh.point(tri.v[0]), &b = mesh.point(tri.v[1]), &c = mesh.point(tri.v[2]);
  if (!isBad(a, b, c, run.bound)) return;
  const TriangleShape shape(a, b, c, run.bound.surface);
  // Shortest edge first; the worst angle first for circumcentres (Erten & Üngör 2007, Section 2.1).
  const bool worst_first = run.variant.worst_first || run.options.algorithm == Algorithm::Circumcenter;
  const std::uint32_t rank = worst_first ? rankOfAngle(shape.cosAt(shape.shortest))
                                         : rankOfLength(shape.squared[shape.shortest], run.steps_together,
                                                        run.blocks.of(tri.v[0]), run.blocks.count());
  run.queue.push(rank, {t, tri.v});
}

void enqueueTouched(RefineRun& run) {
  for (const TriId t : run.touched)
    if (run.mesh.isLive(t)) enqueueIfBad(run, t);
  run.touched.clear();
}

bool removeFreeVertex(RefineRun& run, VertexId v) {
  auto& [patch, polygon, fresh] = run.memory;
  EditMesh& mesh = run.mesh;
  if (!mesh.gatherPatch({&v, 1}, patch) || isBarred(run, patch)) return false;
  polygon.clear();
  for (const BoundaryEdge& r : patch.boundary) polygon.push_back(r.a);
  if (!triangulatePolygon(mesh, polygon, fresh)) return false;
  mesh.replace(patch, fresh, {&v, 1}, run.touched);
  mesh.restoreDelaunay(run.touched);
  return true;
}

void stripFreeVertices(RefineRun& run) {
  EditMesh& mesh = run.mesh;
  for (VertexId v = mesh.inputVertices(); v < mesh.vertexSlots(); ++v) {
    if (!mesh.isLiveVertex(v) || mesh.kind(v) != VertexKind::Free) continue;
    removeFreeVertex(run, v);
    run.touched.clear();
  }
}

TriMesh releaseMesh(RefineRun& run) {
  run.stats.steiner_points = run.mesh.vertexCount() - run.mesh.inputVertices();
  return run.mesh.release();
}

}  // namespace coastmesh
