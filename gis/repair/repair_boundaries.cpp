#include "gis/repair/repair_boundaries.hpp"

#include <map>

namespace coastmesh {
namespace {

// The kind of the open or river boundary at the node.
BoundaryKind openingAt(const RepairState& state, std::uint32_t node) {
  BoundaryKind opening{BoundaryRole::Open};
  for (const std::uint32_t t : state.links.triangles_at[node]) {
    for (const std::uint32_t other : state.grid.triangles[t]) {
      const auto at = state.links.kinds.find(edgeKey(node, other));
      if (other == node || at == state.links.kinds.end()) continue;
      const BoundaryRole role = at->second.role;
      if (role == BoundaryRole::Open || role == BoundaryRole::River) opening = at->second;
    }
  }
  return opening;
}

}  // namespace

BoundaryKinds takeBoundaryKinds(const Grid& grid, const TriMesh& mesh) {
  const EdgeKinds given(grid);
  BoundaryKinds kinds;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh.triangles[t].adj[i] != kNone) continue;
      const std::uint32_t a = mesh.origin(edgeRef(t, i)), b = mesh.target(edgeRef(t, i));
      kinds[edgeKey(a, b)] = given.forCutting(a, b);
    }
  }
  return kinds;
}

void openLoneWall(RepairState& state, const FoundDefect& found) {
  const auto node = static_cast<std::uint32_t>(found.defect.node);
  const TriMesh& mesh = state.links.mesh;
  if (state.anyTaken(state.links.triangles_at[node])) return;
  for (const std::uint32_t t : state.links.triangles_at[node]) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.triangles[t].adj[i] != kNone || mesh.origin(e) != node) continue;
      state.links.kinds[edgeKey(node, mesh.target(e))] = openingAt(state, node);
      state.disturbed[t] = true;
      addRepair(state, found, state.grid.nodes[node], "solid edge between open boundaries opened");
      return;
    }
  }
}

void rebuildBoundaries(RepairState& state) {
  const auto kindOfEdge = [&](std::uint32_t a, std::uint32_t b) {
    const auto at = state.links.kinds.find(edgeKey(a, b));
    return at == state.links.kinds.end() ? BoundaryKind{} : at->second;
  };
  state.grid.boundaries = cutLoops(state.grid, boundaryLoops(state.grid, state.loop), kindOfEdge);
}

void reportRebuilt(RepairState& state, std::span<const FoundDefect> pending, std::size_t boundaries_before) {
  std::map<std::pair<std::optional<Target>, TargetDefectKind>, std::pair<std::size_t, const FoundDefect*>> by_kind;
  for (const FoundDefect& found : pending)
    ++by_kind.try_emplace({found.target, found.defect.kind}, 0, &found).first->second.first;
  for (const auto& [which, counted] : by_kind)
    addRepair(state, *counted.second, counted.second->defect.place,
              "boundaries rebuilt for " + std::to_string(counted.first) +
                  " of it: " + std::to_string(boundaries_before) + " before, " +
                  std::to_string(state.grid.boundaries.size()) + " now");
}

}  // namespace coastmesh
