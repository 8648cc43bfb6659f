#include "gis/repair_shape.hpp"

#include <algorithm>
#include <set>

#include "gis/repair_search.hpp"

namespace coastmesh {
namespace {

// The patch round the triangles, none where part of it has been changed in this round: then another one will do.
std::optional<Patch> untouchedPatch(const RepairState& state, std::span<const std::uint32_t> middle) {
  if (state.anyTaken(middle)) return std::nullopt;
  Patch patch = patchRound(state.view(), middle);
  if (state.anyTaken(patch.triangles)) return std::nullopt;
  return patch;
}

// The grid has the edit's node already, if it adds one.
void applyEdit(RepairState& state, const Patch& patch, const PatchEdit& edit) {
  if (edit.gone) state.links.kinds.erase(*edit.gone);
  for (const auto& [edge, kind] : edit.halves) state.links.kinds[edge] = kind;
  for (const std::uint32_t t : patch.triangles) state.touched[t] = true;
  for (const EditedTriangle& triangle : edit.triangles) {
    if (triangle.slot == kNone) {
      copyTriangle(state.grid, triangle.source, triangle.v);
      for (std::vector<bool>* flags : {&state.touched, &state.changed, &state.disturbed}) flags->push_back(true);
      state.dead.push_back(false);
      continue;
    }
    state.grid.triangles[triangle.slot] = triangle.v;
    state.changed[triangle.slot] = state.disturbed[triangle.slot] = true;
  }
}

void splitEdge(RepairState& state, const NodePair& edge, double share) {
  const auto [a, b] = edge;
  const std::uint32_t middle = addNodeBetween(state.grid, a, b, share);
  if (state.links.line_edges.erase(edge) > 0) state.links.line_edges.insert({edgeKey(a, middle), edgeKey(middle, b)});
}

// Whether the attempt was made; `done` says whether it did anything.
struct Attempt {
  bool made = false, done = false;
};

Attempt splitNode(RepairState& state, std::uint32_t node, const FoundDefect& found) {
  const auto patch = untouchedPatch(state, state.links.triangles_at[node]);
  if (!patch) return {};
  const std::optional<PatchEdit> chosen = bestNodeSplit(state.view(), node, *patch);
  if (!chosen) return {true, false};
  copyNode(state.grid, node, *chosen->fresh);
  applyEdit(state, *patch, *chosen);
  addRepair(state, found, found.defect.place, "node split in two");
  return {true, true};
}

Attempt reshape(RepairState& state, std::span<const std::uint32_t> middle, const FoundDefect& found) {
  std::set<std::uint32_t> concerned(middle.begin(), middle.end());
  for (const std::uint32_t t : middle)
    for (const EdgeRef twin : state.links.mesh.triangles[t].adj)
      if (twin != kNone) concerned.insert(triOf(twin));
  const std::vector<std::uint32_t> inside(concerned.begin(), concerned.end());
  const auto patch = untouchedPatch(state, inside);
  if (!patch) return {};
  const std::optional<Reshaping> chosen = bestReshaping(state.view(), inside, *patch);
  if (!chosen) return {true, false};
  if (chosen->split_at) splitEdge(state, chosen->edge, *chosen->split_at);
  applyEdit(state, *patch, chosen->edit);
  addRepair(state, found, found.defect.place, chosen->split_at ? "edge split" : "edge flipped");
  return {true, true};
}

// An inner node of three triangles goes, and these become one.
void takeOutNode(RepairState& state, std::uint32_t node, const FoundDefect& found) {
  const std::vector<std::uint32_t>& round = state.links.triangles_at[node];
  if (round.size() < 3 || !fixedNeighbours(state.view(), node).empty() || state.anyTaken(round)) return;
  GridCorners corners = state.grid.triangles[round[0]];
  // What the other two have and the first has not takes the node's place.
  for (const std::uint32_t other : state.grid.triangles[round[1]])
    if (std::ranges::count(corners, other) == 0) std::ranges::replace(corners, node, other);
  state.grid.triangles[round[0]] = corners;
  for (const std::uint32_t t : round) state.touched[t] = state.disturbed[t] = true;
  state.changed[round[0]] = state.dead[round[1]] = state.dead[round[2]] = true;
  addRepair(state, found, found.defect.place, "node taken out");
}

}  // namespace

void reshapeTriangle(RepairState& state, const FoundDefect& found) {
  const auto t = static_cast<std::uint32_t>(found.defect.triangle);
  if (state.hopeless_triangles[t]) return;
  const Attempt attempt = reshape(state, std::array{t}, found);
  state.hopeless_triangles[t] = attempt.made && !attempt.done;
}

void mendValence(RepairState& state, const FoundDefect& found) {
  const auto node = static_cast<std::uint32_t>(found.defect.node);
  const std::vector<std::uint32_t>& round = state.links.triangles_at[node];
  if (round.size() <= 3) return takeOutNode(state, node, found);
  if (state.hopeless_nodes[node]) return;
  const Attempt reshaped = reshape(state, round, found);
  if (reshaped.done) return;
  const Attempt was_split = splitNode(state, node, found);
  state.hopeless_nodes[node] = reshaped.made && was_split.made && !was_split.done;
}

}  // namespace coastmesh
