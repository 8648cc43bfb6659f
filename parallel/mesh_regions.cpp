#include "parallel/mesh_regions.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/lattice/lattice_core.hpp"
#include "core/optimise/optimise.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/check_input.hpp"
#include "core/refine/divide_segments.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/run_control.hpp"
#include "core/size/plane_sizes.hpp"
#include "core/sphere/far_side.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"
#include "parallel/byte_hash.hpp"
#include "parallel/bytes.hpp"
#include "parallel/deal.hpp"
#include "parallel/free_memory.hpp"
#include "parallel/piece_context.hpp"
#include "parallel/recorder.hpp"
#include "parallel/round_keeper.hpp"
#include "parallel/rounds.hpp"

namespace coastmesh {

namespace {

// Expected triangles from which cutting pays.
constexpr double kWorthCutting = 60000.0;

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

int optimiseSweeps(const MeshOptions& options) {
  if (options.smooth) return kMostOptimiseSweeps;
  return options.refine.size != nullptr && options.coarsen ? kOptimiseSweeps : 0;
}

// Progress of refinement, coarsening and optimisation, which take about as long as one another.
class StageControls {
 public:
  StageControls(const MeshOptions& options, const RunControl& control)
      : control_(control), stages_(1 + int{options.coarsen} + int{optimiseSweeps(options) > 0}) {}

  RunControl next() {
    const double from = begun_++;
    return stageControl(control_, {from / stages_, (from + 1.0) / stages_});
  }

 private:
  const RunControl& control_;
  int stages_, begun_ = 0;
};

// The bounding box of a mesh.
std::pair<Point, Point> extentOf(const TriMesh& mesh) {
  Point low = mesh.points.front(), high = low;
  for (const Point& p : mesh.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low, high};
}

// `size_max` as a length in the plane: exact where the scale factor is largest, at most 2 % too short elsewhere.
// Infinite if the factor varies by more than that over the box.
double longestInPlane(const RefineOptions& options, const Point& low, const Point& high) {
  constexpr double kAlike = 0.98;
  const auto farOf = [](double from, double to) { return std::max(std::abs(from), std::abs(to)); };
  const auto nearOf = [](double from, double to) { return std::max({from, -to, 0.0}); };
  const double least = options.surface.shrinkAt({farOf(low.x, high.x), farOf(low.y, high.y)});
  const double most = options.surface.shrinkAt({nearOf(low.x, high.x), nearOf(low.y, high.y)});
  return least < kAlike * most ? std::numeric_limits<double>::infinity() : options.size_max / most;
}

// The lattices to begin with: where requested lengths determine the mesh, most vertices are known in advance.
// Algorithms for comparison stay as published. `most_in_memory` must have no influence: the mesh would depend on it.
std::vector<LatticePlaces> placesFor(const TriMesh& mesh, const RefineOptions& options, const ItemLoop& loop) {
  if (options.algorithm != Algorithm::Relocate) return {};
  const std::uint64_t most = std::min(options.max_vertices, kMostVertices);
  const std::uint64_t left = most - std::min<std::uint64_t>(most, mesh.points.size());
  LatticeWishes wishes{options.size_max, options.size, options.min_angle_deg, options.max_angle_deg, left};
  if (!options.surface.isCurved() || mesh.points.empty()) return layLattices(mesh, wishes, loop);
  const auto [low, high] = extentOf(mesh);
  wishes.size_max = longestInPlane(options, low, high);
  if (options.size == nullptr) return layLattices(mesh, wishes, loop);
  const PlaneSizes in_plane(*options.size, options.surface, low, high);
  wishes.size = &in_plane;
  return layLattices(mesh, wishes, loop);
}

// Throws OutOfRoom.
std::vector<LatticePlaces> latticesFor(const TriMesh& mesh, const RefineOptions& options, const ItemLoop& loop) {
  std::vector<LatticePlaces> lattices = placesFor(mesh, options, loop);
  std::uint64_t vertices = mesh.points.size();
  for (const LatticePlaces& lattice : lattices) vertices += static_cast<std::uint64_t>(lattice.places.count());
  if (vertices > options.most_in_memory) throw OutOfRoom(mesh.points.front());
  return lattices;
}

// The PSLG with the ring of the cap around it.
Pslg withRing(const Pslg& pslg, const MeshOptions& options) {
  Pslg all = pslg;
  const auto first = static_cast<VertexId>(pslg.points.size()),
             corners = static_cast<VertexId>(options.cap.ring.size());
  all.points.insert(all.points.end(), options.cap.ring.begin(), options.cap.ring.end());
  for (VertexId i = 0; i < corners; ++i)
    all.segments.push_back({first + i, first + (i + 1) % corners, 0, options.cap_region, kOutside});
  return all;
}

TriMesh triangulateInRing(const Pslg& pslg, const MeshOptions& options, std::span<const Point> seeds,
                          const ItemLoop& loop) {
  Pslg all = withRing(pslg, options);
  const std::size_t fixed = all.points.size();
  all.points.insert(all.points.end(), seeds.begin(), seeds.end());
  TriMesh mesh = constrainedDelaunay(all, options.refine.surface, loop);
  mesh.input_vertices = static_cast<VertexId>(fixed);
  freezeRing(mesh, static_cast<VertexId>(pslg.points.size()), options.cap);
  return mesh;
}

// Data on a mesh that begins with further vertices: lattice points or seeds.
struct Seeds {
  VertexNotes input;               // notes on the input only; empty if there are no cores
  VertexNotes notes;               // on all vertices; empty if none were added and the mesh is not to be cut
  std::vector<LatticeCore> cores;  // kept out of the mesh
  std::uint64_t core_vertices = 0;
  bool are_segments_split = false;
};

// Triangulates again, with further vertices that are not the input's.
void triangulateAgain(MeshedRegion& region, const Pslg& pslg, std::span<const Point> further, Seeds& seeds,
                      const RefineOptions& options, const ItemLoop& loop) {
  Pslg all = pslg;
  all.points.insert(all.points.end(), further.begin(), further.end());
  seeds.notes = noteInput(region.mesh, boundOf(options), loop);
  region.mesh = constrainedDelaunay(all, options.surface, loop);
  region.mesh.input_vertices = static_cast<VertexId>(pslg.points.size());
  noteFurther(region.mesh, seeds.notes, {}, loop);
}

// For a mesh to be closed: inserts its initial vertices.
Seeds seedInRing(MeshedRegion& region, const Pslg& pslg, const MeshOptions& options, const RunControl& control) {
  Recorder recorder;
  const ItemLoop loop = recorder.loop("triangulate", control);
  Seeds seeds;
  seeds.notes = noteInput(region.mesh, boundOf(options.refine), loop);
  if (!options.seeds.empty()) {
    region.mesh = triangulateInRing(pslg, options, options.seeds, loop);
    noteFurther(region.mesh, seeds.notes, {}, loop);
  }
  region.log.append(recorder.finish("triangulate"));
  return seeds;
}

// How many more vertices the mesh may have beside these lattices.
std::uint64_t roomBeside(const std::vector<LatticePlaces>& lattices, const TriMesh& mesh,
                         const RefineOptions& options) {
  std::uint64_t vertices = mesh.points.size();
  for (const LatticePlaces& lattice : lattices) vertices += static_cast<std::uint64_t>(lattice.places.count());
  const std::uint64_t most = std::min(options.max_vertices, kMostVertices);
  return most - std::min(most, vertices);
}

// Triangulates again if there are lattices to insert.
Seeds seed(MeshedRegion& region, const Pslg& pslg, const MeshOptions& all_options, bool with_cores,
           const RunControl& control) {
  if (!all_options.cap.empty()) return seedInRing(region, pslg, all_options, control);
  const RefineOptions& options = all_options.refine;
  Recorder recorder;
  const ItemLoop loop = recorder.loop("triangulate", control);
  Seeds seeds;
  std::vector<LatticePlaces> lattices = latticesFor(region.mesh, options, recorder.loop("lattice", control));
  if (with_cores || !lattices.empty()) seeds.notes = noteInput(region.mesh, boundOf(options), loop);
  if (!lattices.empty()) {
    DividedSegments divided;
    if (with_cores)
      divided =
          divideSegments(region.mesh, pslg, seeds.notes, options, roomBeside(lattices, region.mesh, options), loop);
    LatticeMesh seeded = triangulateWith(pslg, std::move(lattices), with_cores, divided, loop);
    if (!seeded.cores.empty()) seeds.input = seeds.notes;
    noteFurther(seeded.mesh, seeds.notes, divided.spacing, loop);
    seeds.are_segments_split = !divided.pieces.empty();
    region.stats.segment_splits += divided.points.size();
    seeds.core_vertices = seeded.coreVertices();
    seeds.cores = std::move(seeded.cores);
    region.mesh = std::move(seeded.mesh);
  } else if (options.surface.isCurved()) {
    const std::vector<Point> far = farSideVertices(region.mesh, options.surface);
    if (!far.empty()) triangulateAgain(region, pslg, far, seeds, options, loop);
  }
  region.log.append(recorder.finish("triangulate"));
  return seeds;
}

void meshWhole(MeshedRegion& region, const Pslg& pslg, const MeshOptions& options, const RunControl& control) {
  Stopwatch watch;
  Seeds seeds = seed(region, pslg, options, false, control);
  region.seconds.triangulate += watch.lap();
  Recorder recorder;
  StageControls stages(options, control);
  // The overload without notes tries several variants on a small input, and needs a mesh without further vertices.
  region.stats = options.cap.empty() && region.mesh.points.size() == pslg.points.size()
                     ? refine(region.mesh, pslg, options.refine, stages.next())
                     : refine(region.mesh, pslg, options.refine, std::move(seeds.notes), stages.next());
  region.seconds.refine = watch.lap();
  // Input vertices are never removed.
  if (options.coarsen && region.mesh.points.size() > region.mesh.input_vertices) {
    RefineStats coarsened = coarsen(region.mesh, pslg, options.refine, stages.next());
    region.seconds.coarsen = watch.lap();
    region.stats.unresolved.clear();
    region.stats.add(coarsened);
  }
  if (const int sweeps = optimiseSweeps(options); sweeps > 0) {
    RefineStats optimised = optimise(region.mesh, pslg, options.refine, sweeps, stages.next());
    region.seconds.optimise = watch.lap();
    region.stats.unresolved.clear();
    region.stats.add(optimised);
  }
  region.log.append(recorder.finish("refine"));
}

// Repairs, in the whole mesh, triangles that could not be repaired while cores were kept out of it: first by local
// repairs, which leave the rest unchanged, then by refining ever larger surroundings of them. What local repairs in
// pieces leave is taken out again before it is repaired uncut: few places, on one thread. An attempt that leaves as
// many bad triangles is undone.
template <typename Add>
void mendBesideCores(MeshedRegion& region, std::vector<TriId> bad, const Pslg& pslg, const RefineOptions& options,
                     const VertexNotes& notes, const HelpedRegion* helpers, const RunControl& control, const Add& add) {
  struct Attempt {
    unsigned edges;
    Mending how;
  };
  // At 41° and more repairs give up after many failures; each further attempt mends some. Refining 256 edges around a
  // triangle has doubled a mesh.
  constexpr std::array kAttempts{Attempt{10, Mending::RepairInPieces}, Attempt{32, Mending::RepairUncut},
                                 Attempt{100, Mending::RepairUncut},   Attempt{40, Mending::RepairInPieces},
                                 Attempt{100, Mending::RepairUncut},   Attempt{64, Mending::Refine},
                                 Attempt{256, Mending::Refine}};
  TriMesh& mesh = region.mesh;
  for (const auto& [edges, how] : kAttempts) {
    if (bad.empty()) break;
    Recorder before;
    Submesh patch = extractNear(mesh, notes, bad, edges, before.loop("stitch", control));
    region.log.append(before.finish("stitch"));
    const std::uint64_t rest = mesh.points.size() - patch.parent.size();
    RefineOptions own = options;
    own.max_vertices -= std::min(own.max_vertices, rest);
    RoundsWorkspace workspace;
    workspace.helpers = helpers;
    TriMesh solved = std::move(patch.mesh);
    RoundsReport report = mendInRounds(solved, pslg, own, std::move(patch.notes), how, control, workspace);
    report.pieces = 0;  // those of a patch do not count
    const bool is_full = report.stats.budget_reached;
    Recorder after;
    std::vector<TriId> left = trianglesInViolation(solved, options, notes.corners.get(), after.loop("stitch", control));
    if (left.size() >= bad.size()) {
      region.stats.budget_reached |= is_full;
      region.log.append(std::move(report.log));
      region.log.append(after.finish("stitch"));
      continue;
    }
    add(std::move(report));
    const BulkList<TriId> number = putBack(mesh, patch, solved, after.loop("stitch", control));
    for (TriId& t : left) t = number[t];
    bad = std::move(left);
    region.log.append(after.finish("stitch"));
    if (is_full) break;
  }
}

// A hash of everything that the mesh of a region depends on. Excludes `most_in_memory`, which may differ in the next
// run.
std::uint64_t fingerprintOf(const TriMesh& seeded, const Pslg& pslg, const MeshOptions& options,
                            const VertexNotes& notes) {
  RefineOptions lasting = options.refine;
  lasting.most_in_memory = 0;
  ByteHash hash;
  hash.add(contextBytes(pslg, lasting, notes.corners.get()));
  ByteWriter further;
  further.pass(options.coarsen);
  further.pass(optimiseSweeps(options));
  further.pass(digestOf(seeded));
  hash.add(further.take());
  return hash.value();
}

void meshInPieces(MeshedRegion& region, const Pslg& pslg, const MeshOptions& options, const RunControl& control) {
  CutTree cuts;
  const auto add = [&](RoundsReport&& report) {
    region.stats.add(report.stats);
    if (report.pieces > region.pieces) {
      region.pieces = report.pieces;
      cuts = std::move(report.cuts);
    }
    region.log.append(std::move(report.log));
  };
  Stopwatch watch;
  Seeds seeds = seed(region, pslg, options, true, control);
  RefineOptions around = options.refine;
  around.max_vertices -= std::min(around.max_vertices, seeds.core_vertices);
  std::optional<HelpedRegion> helped;
  if (options.helpers != nullptr)
    helped.emplace(*options.helpers, contextBytes(pslg, options.refine, seeds.notes.corners.get()));
  const HelpedRegion* const helpers = helped ? &*helped : nullptr;
  std::optional<RoundKeeper> keeper;
  if (options.checkpoint != nullptr)
    keeper.emplace(*options.checkpoint, fingerprintOf(region.mesh, pslg, options, seeds.notes), seeds.notes);
  RoundsWorkspace workspace;
  workspace.helpers = helpers;
  workspace.keeper = keeper ? &*keeper : nullptr;
  workspace.has_cores = !seeds.cores.empty();
  workspace.are_segments_split = seeds.are_segments_split;
  // Begins a stage, with the results of those before it; false if an earlier run has completed it.
  const auto begins = [&](RoundsStage stage) {
    if (!keeper) return true;
    if (keeper->isPast(stage)) return false;
    const RoundsTally& before = keeper->begin(stage, {region.stats, region.pieces, cuts, 0});
    region.stats = before.stats;
    region.pieces = before.pieces;
    cuts = before.cuts;
    return true;
  };
  region.seconds.triangulate += watch.lap();
  StageControls stages(options, control);
  const RunControl refining = stages.next();
  if (begins(RoundsStage::Refine))
    add(refineInRounds(region.mesh, pslg, around, std::move(seeds.notes), refining, workspace));
  region.seconds.refine = watch.lap();
  if (seeds.cores.empty()) giveBackFreeMemory();
  if (options.coarsen && begins(RoundsStage::Coarsen)) {
    add(coarsenInRounds(region.mesh, pslg, around, stages.next(), workspace));
    region.seconds.coarsen = watch.lap();
  }
  if (const int sweeps = optimiseSweeps(options); sweeps > 0 && begins(RoundsStage::Optimise)) {
    add(optimiseInRounds(region.mesh, pslg, around, sweeps, stages.next(), workspace));
    region.seconds.optimise = watch.lap();
  }
  workspace = {};
  if (!seeds.cores.empty()) {
    Recorder recorder;
    const ItemLoop stitch = recorder.loop("stitch", control);
    const std::vector<TriId> left =
        trianglesInViolation(region.mesh, options.refine, seeds.input.corners.get(), stitch);
    insertCores(region.mesh, static_cast<VertexId>(pslg.points.size()), seeds.cores, stitch);
    region.log.append(recorder.finish("stitch"));
    // With too few vertices triangles are bad everywhere.
    if (!region.stats.budget_reached)
      mendBesideCores(region, left, pslg, options.refine, seeds.input, helpers, {control.cancelled, {}}, add);
  }
  Recorder recorder;
  const ItemLoop label = recorder.loop("label", control);
  if (options.cap.empty() && options.list_violations)
    region.stats.unresolved = findBoundViolations(region.mesh, options.refine, label);
  if (seeds.cores.empty()) giveBackFreeMemory();
  if (options.cap.empty()) labelRegions(region.mesh, pslg, label);
  if (options.mark_pieces) region.piece_of = piecesOf(region.mesh, cuts, label);
  region.log.append(recorder.finish());
  region.seconds.stitch = watch.lap();
}

// Makes the lattice the result, without regions, and returns true if it meets the bounds; otherwise its vertices become
// seeds.
bool takeLattice(MeshedRegion& region, MeshOptions& options, const ItemLoop& loop) {
  TriMesh& lattice = options.lattice;
  if (lattice.triangles.empty()) return false;
  if (trianglesInViolation(lattice, options.refine, nullptr, loop).empty()) {
    region.mesh = std::move(lattice);
    return true;
  }
  options.seeds.assign(lattice.points.begin() + static_cast<std::ptrdiff_t>(options.cap.ring.size()),
                       lattice.points.end() - 1);
  lattice = {};
  return false;
}

void closeRegion(MeshedRegion& region, const Pslg& pslg, const MeshOptions& options, const RunControl& control) {
  Stopwatch watch;
  Recorder recorder;
  const ItemLoop label = recorder.loop("label", control);
  closeSphere(region.mesh, static_cast<VertexId>(pslg.points.size()), options.cap);
  region.mesh.input_vertices = static_cast<VertexId>(pslg.points.size());
  if (pslg.segments.empty()) {
    region.mesh.regions.assign(region.mesh.triangles.size(), options.cap_region);
  } else {
    labelRegions(region.mesh, pslg);
  }
  if (options.list_violations) region.stats.unresolved = findBoundViolations(region.mesh, options.refine, label);
  if (!region.piece_of.empty()) region.piece_of.resize(region.mesh.triangles.size(), 0);
  region.log.append(recorder.finish("stitch"));
  region.seconds.stitch += watch.lap();
}

}  // namespace

MeshedRegion meshRegion(const Pslg& pslg, MeshOptions options, const RunControl& control) {
  requireInRange(options.refine);
  MeshedRegion region;
  Stopwatch watch;
  Recorder recorder;
  const bool closed = !options.cap.empty();
  const bool done = takeLattice(region, options, recorder.loop("lattice", control));
  const ItemLoop triangulate = recorder.loop("triangulate", control);
  if (!done)
    region.mesh =
        closed ? triangulateInRing(pslg, options, {}, triangulate) : constrainedDelaunay(pslg, {}, triangulate);
  if (!done && !closed && !labelsTellAll(pslg)) region.cover = coverOf(region.mesh, pslg);
  const bool cut =
      !done && !options.one_piece && expectedTriangles(region.mesh, options.refine, triangulate) >= kWorthCutting;
  region.seconds.triangulate = watch.lap();
  region.log.append(recorder.finish("triangulate"));
  if (!done) (cut ? meshInPieces : meshWhole)(region, pslg, options, control);
  if (options.mark_pieces && !cut) region.piece_of.assign(region.mesh.triangles.size(), 0);
  if (done) {
    region.mesh.regions.assign(region.mesh.triangles.size(), options.cap_region);
  } else if (closed) {
    closeRegion(region, pslg, options, control);
  }
  region.stats.steiner_points = region.mesh.points.size() - region.mesh.input_vertices;
  return region;
}

}  // namespace coastmesh
