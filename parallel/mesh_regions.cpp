#include "parallel/mesh_regions.hpp"

#include <chrono>
#include <utility>

#include "core/delaunay.hpp"
#include "core/label_regions.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/optimise.hpp"
#include "parallel/recorder.hpp"
#include "parallel/rounds.hpp"

namespace coastmesh {

namespace {

// Cutting pays from so many triangles on.
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

void meshWhole(MeshedRegion& region, const Pslg& pslg, const MeshOptions& options, const RunControl& control) {
  Stopwatch watch;
  Recorder recorder;
  region.stats = refine(region.mesh, pslg, options.refine, control);
  region.seconds.refine = watch.lap();
  if (options.coarsen) {
    RefineStats coarsened = coarsen(region.mesh, pslg, options.refine, control);
    region.seconds.coarsen = watch.lap();
    region.stats.unresolved.clear();
    region.stats.add(coarsened);
  }
  if (const int sweeps = optimiseSweeps(options); sweeps > 0) {
    RefineStats optimised = optimise(region.mesh, pslg, options.refine, sweeps, control);
    region.seconds.optimise = watch.lap();
    region.stats.unresolved.clear();
    region.stats.add(optimised);
  }
  region.log.append(recorder.finish("refine"));
}

void meshInPieces(MeshedRegion& region, const Pslg& pslg, const MeshOptions& options, const RunControl& control) {
  RoundsWorkspace workspace;
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
  add(refineInRounds(region.mesh, pslg, options.refine, control, workspace));
  region.seconds.refine = watch.lap();
  if (options.coarsen) {
    add(coarsenInRounds(region.mesh, pslg, options.refine, control, workspace));
    region.seconds.coarsen = watch.lap();
  }
  if (const int sweeps = optimiseSweeps(options); sweeps > 0) {
    add(optimiseInRounds(region.mesh, pslg, options.refine, sweeps, control, workspace));
    region.seconds.optimise = watch.lap();
  }
  Recorder recorder;
  region.stats.unresolved = findBoundViolations(region.mesh, options.refine, recorder.loop("label", control));
  labelRegions(region.mesh, pslg);
  if (options.mark_pieces) region.piece_of = piecesOf(region.mesh, cuts, recorder.loop("label", control));
  region.log.append(recorder.finish());
  region.seconds.stitch = watch.lap();
}

}  // namespace

MeshedRegion meshRegion(const Pslg& pslg, const MeshOptions& options, const RunControl& control) {
  requireInRange(options.refine);
  MeshedRegion region;
  Stopwatch watch;
  Recorder recorder;
  region.mesh = constrainedDelaunay(pslg);
  region.seconds.triangulate = watch.lap();
  region.log.append(recorder.finish("triangulate"));
  const bool cut = !options.one_piece && expectedTriangles(region.mesh, options.refine) >= kWorthCutting;
  (cut ? meshInPieces : meshWhole)(region, pslg, options, control);
  if (options.mark_pieces && !cut) region.piece_of.assign(region.mesh.triangles.size(), 0);
  region.stats.steiner_points = region.mesh.points.size() - region.mesh.input_vertices;
  return region;
}

}  // namespace coastmesh
