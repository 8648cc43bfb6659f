#include "core/refine/refine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/mend_triangles.hpp"
#include "core/refine/split_segments.hpp"
#include "core/triangulate/label_regions.hpp"

namespace coastmesh {

namespace {

// Neither labels regions nor lists unresolved triangles.
RefineStats refineOnce(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                       const RefineVariant& variant, const RunControl& control) {
  const std::uint64_t splits = wantsSplitSegments(mesh, options) ? splitSegments(mesh, pslg, notes, options) : 0;
  RefineRun run(std::move(mesh), pslg, options, std::move(notes), variant);
  refineAll(run, control);
  if (options.algorithm == Algorithm::Relocate) {
    growCornerTriangles(run, Beyond::StaysGood, control);
    repair(run, control);
  }
  mesh = releaseMesh(run);
  run.stats.segment_splits += splits;
  return std::move(run.stats);
}

RefineStats finish(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, RefineStats&& stats) {
  labelRegions(mesh, pslg);
  stats.unresolved = findBoundViolations(mesh, options);
  return std::move(stats);
}

// Up to this many points it costs next to nothing to refine in several ways and keep the smallest mesh after
// coarsening.
constexpr VertexId kFewPoints = 64;
// Large meshes of few points come from a bound on lengths; other variants hardly need fewer vertices there.
constexpr std::size_t kLargeMesh = 2000;

// Largest usual aim (degrees): few points need less slack than many.
constexpr double kMostUsualAim = 1.0;

std::vector<RefineVariant> furtherVariants(const RefineOptions& options) {
  const RefineVariant usual = usualVariant(options);
  std::vector<RefineVariant> variants;
  for (const double aim_deg : {0.0, 0.25, 0.5, 1.0, 2.0, 3.0}) {
    for (const bool worst_first : {false, true}) {
      RefineVariant variant = usual;
      variant.aim_deg = std::min(usual.aim_deg, kMostUsualAim) + aim_deg;
      variant.worst_first = worst_first;
      if (variant.aim_deg != usual.aim_deg || worst_first) variants.push_back(variant);
    }
  }
  return variants;
}

}  // namespace

RefineStats refine(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  requireInRange(options);
  const bool few =
      mesh.input_vertices <= kFewPoints && options.algorithm == Algorithm::Relocate && options.size == nullptr;
  const TriMesh unrefined = few ? mesh : TriMesh();
  const VertexNotes notes = noteInput(mesh, boundOf(options));
  RefineStats stats =
      finish(mesh, pslg, options, refineOnce(mesh, pslg, options, notes, usualVariant(options), control));
  if (!few || !stats.unresolved.empty() || stats.budget_reached) return stats;
  if (mesh.points.size() == mesh.input_vertices) return stats;  // the smallest possible
  if (mesh.points.size() > kLargeMesh) return stats;
  std::size_t smallest = coarsenedSize(mesh, pslg, options, control);
  // Meshes of the same points are the same, except for ties: three in four of the further ones.
  std::vector<BulkList<Point>> known{mesh.points};
  for (const RefineVariant& variant : furtherVariants(options)) {
    // The input requires a Steiner point, so no mesh has none.
    if (smallest <= mesh.input_vertices + 1) break;
    TriMesh other = unrefined;
    RefineStats other_stats = refineOnce(other, pslg, options, notes, variant, control);
    if (other_stats.budget_reached) continue;
    if (std::ranges::find(known, other.points) != known.end()) continue;
    known.push_back(other.points);
    const std::size_t size = coarsenedSize(other, pslg, options, control);
    if (size >= smallest) continue;
    other_stats = finish(other, pslg, options, std::move(other_stats));
    if (!other_stats.unresolved.empty()) continue;
    smallest = size;
    mesh = std::move(other);
    stats = std::move(other_stats);
  }
  return stats;
}

RefineStats refine(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, VertexNotes notes,
                   const RunControl& control) {
  requireInRange(options);
  return finish(mesh, pslg, options, refineOnce(mesh, pslg, options, std::move(notes), usualVariant(options), control));
}

}  // namespace coastmesh
