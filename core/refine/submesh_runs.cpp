#include "core/refine/submesh_runs.hpp"

#include <algorithm>
#include <utility>

#include "core/refine/refiner.hpp"
#include "core/refine/repair.hpp"

namespace coastmesh {

namespace {

Refiner takeSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options) {
  RefineVariant variant = usualVariant(options);
  variant.clear_of_frozen = true;
  return Refiner(std::move(state.mesh), pslg, options, std::move(state.notes), variant);
}

RefineStats giveBack(Refiner& refiner, MeshState& state) {
  state.mesh = refiner.release(state.notes, state.due_triangles);
  RefineStats stats = std::move(refiner.stats());
  stats.steiner_points = 0;
  return stats;
}

}  // namespace

RefineStats refineSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, bool mends,
                          const RunControl& control) {
  std::vector<std::uint8_t> due = std::move(state.due_triangles);
  Refiner refiner = takeSubmesh(state, pslg, options);

  std::vector<TriId> first;
  std::vector<BadTriangle> given_up;
  for (TriId t = 0; t < due.size(); ++t) {
    if (due[t]) {
      first.push_back(t);
    } else if (mends && refiner.violatesBound(t)) {
      given_up.push_back({t, refiner.mesh().triangle(t).v});
    }
  }
  refiner.resume(first, control);
  if (mends && options.algorithm == Algorithm::Relocate) {
    refiner.growFans(Refiner::Beyond::StaysGood, control);
    repair(refiner, pslg, options, control, given_up);
  }
  return giveBack(refiner, state);
}

RefineStats repairSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  Refiner refiner = takeSubmesh(state, pslg, options);
  repair(refiner, pslg, options, control);
  return giveBack(refiner, state);
}

MeshState releaseDue(EditMesh& mesh, std::vector<std::uint8_t> due) {
  std::vector<EdgeRef> star;
  const auto isAtFrozenEdge = [&](VertexId v) {
    mesh.star(v, star);
    return std::ranges::any_of(star, [&](EdgeRef e) { return mesh.segment(e) == kFrozen; });
  };
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v)
    due[v] = due[v] && mesh.isLiveVertex(v) && (v < mesh.inputVertices() || isAtFrozenEdge(v));
  MeshState state;
  Renumbering by;
  state.mesh = mesh.release(by, false);
  state.due_vertices.assign(state.mesh.points.size(), 0);
  for (VertexId v = 0; v < by.vertex.size(); ++v)
    if (by.vertex[v] != kNone) state.due_vertices[by.vertex[v]] = due[v];
  return state;
}

}  // namespace coastmesh
