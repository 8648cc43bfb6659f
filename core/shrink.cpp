#include "core/refine.hpp"
#include "core/shortfalls.hpp"

namespace coastmesh {

RefineStats shrink(TriMesh& mesh, const Pslg&, const RefineOptions& options, const RunControl&) {
  RefineStats stats;
  stats.unresolved = findShortfalls(mesh, options);
  return stats;
}

}  // namespace coastmesh
