#include "core/refine.hpp"

#include <utility>

#include "core/label_regions.hpp"
#include "core/refiner.hpp"
#include "core/repair.hpp"
#include "core/shortfalls.hpp"

namespace coastmesh {

void RefineStats::add(const RefineStats& other) {
  steiner_points += other.steiner_points;
  for (std::size_t i = 0; i < by_type.size(); ++i) by_type[i] += other.by_type[i];
  segment_splits += other.segment_splits;
  relocations += other.relocations;
  removals += other.removals;
  merges += other.merges;
  budget_reached |= other.budget_reached;
  unresolved.insert(unresolved.end(), other.unresolved.begin(), other.unresolved.end());
}

RefineStats refine(TriMesh& mesh, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  Refiner refiner(std::move(mesh), pslg, options);
  refiner.run(control);
  if (options.algorithm == Algorithm::Relocate) repair(refiner, pslg, options, control);
  mesh = refiner.release();
  labelRegions(mesh, pslg);
  RefineStats stats = std::move(refiner.stats());
  stats.unresolved = findShortfalls(mesh, options);
  return stats;
}

}  // namespace coastmesh
