#include "core/optimise/optimise.hpp"

#include <utility>

#include "core/optimise/optimiser.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/triangulate/label_regions.hpp"

namespace coastmesh {

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
