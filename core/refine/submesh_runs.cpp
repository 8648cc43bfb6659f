#include "core/refine/submesh_runs.hpp"

#include <algorithm>
#include <utility>

#include "core/refine/mend_triangles.hpp"

namespace coastmesh {

namespace {

RefineRun takeSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options) {
  RefineVariant variant = usualVariant(options);
  variant.clear_of_frozen = true;
  return RefineRun(std::move(state.mesh), pslg, options, std::move(state.notes), variant);
}

// Returns the mesh, the notes on its vertices, and as due the triangles that were kept for later.
RefineStats giveBack(RefineRun& run, MeshState& state) {
  std::erase_if(run.deferred, [&](const auto& entry) { return !isDeferred(run, entry.first); });
  Renumbering by;
  state.mesh = run.mesh.release(by, false);
  state.due_triangles.assign(state.mesh.triangles.size(), 0);
  for (const auto& [t, corners] : run.deferred) state.due_triangles[by.triangle[t]] = 1;
  BulkList<double> spacing(state.mesh.points.size());
  for (VertexId v = 0; v < by.vertex.size(); ++v)
    if (by.vertex[v] != kNone) spacing[by.vertex[v]] = run.notes.spacing[v];
  state.notes = std::move(run.notes);
  state.notes.spacing = std::move(spacing);
  RefineStats stats = std::move(run.stats);
  stats.steiner_points = 0;
  return stats;
}

}  // namespace

RefineStats refineSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, bool mends,
                          const RunControl& control) {
  std::vector<std::uint8_t> due = std::move(state.due_triangles);
  RefineRun run = takeSubmesh(state, pslg, options);

  std::vector<TriId> first;
  std::vector<BadTriangle> given_up;
  for (TriId t = 0; t < due.size(); ++t) {
    if (due[t]) {
      first.push_back(t);
    } else if (mends && violatesBound(run, t)) {
      given_up.push_back({t, run.mesh.triangle(t).v});
    }
  }
  resume(run, first, control);
  if (mends && options.algorithm == Algorithm::Relocate) {
    growCornerTriangles(run, Beyond::StaysGood, control);
    repair(run, control, given_up);
  }
  return giveBack(run, state);
}

RefineStats repairSubmesh(MeshState& state, const Pslg& pslg, const RefineOptions& options, const RunControl& control) {
  RefineRun run = takeSubmesh(state, pslg, options);
  repair(run, control);
  return giveBack(run, state);
}

MeshState releaseDue(EditMesh& mesh, std::vector<std::uint8_t> due, std::span<const VertexId> waiting) {
  std::vector<EdgeRef> star;
  const auto isAtFrozenEdge = [&](VertexId v) {
    mesh.star(v, star);
    return std::ranges::any_of(star, [&](EdgeRef e) { return mesh.segment(e) == kFrozen; });
  };
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v)
    due[v] = due[v] && mesh.isLiveVertex(v) && (v < mesh.inputVertices() || isAtFrozenEdge(v));
  for (const VertexId v : waiting) due[v] = mesh.isLiveVertex(v);
  MeshState state;
  Renumbering by;
  state.mesh = mesh.release(by, false);
  state.due_vertices.assign(state.mesh.points.size(), 0);
  for (VertexId v = 0; v < by.vertex.size(); ++v)
    if (by.vertex[v] != kNone) state.due_vertices[by.vertex[v]] = due[v];
  return state;
}

}  // namespace coastmesh
