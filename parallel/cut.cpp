#include "parallel/cut.hpp"

#include <algorithm>
#include <utility>

namespace coastmesh {

CutSubmesh cutOut(const MeshState& whole, const Partition& partition, PieceId piece, VertexNumbers& numbers) {
  numbers.setVertices(whole.mesh.points.size());
  const std::span<const TriId> triangles = partition.of(piece);
  const auto slotOf = [&](TriId t) { return partition.piece_of[t] == piece ? partition.slot_of[t] : kNone; };
  const auto numberOf = [&](VertexId v) -> VertexId& { return numbers[v]; };
  Submesh sub = extractSubmesh(whole.mesh, whole.mesh.input_vertices, whole.notes, triangles, slotOf, numberOf);

  CutSubmesh cut;
  for (const EdgeRef e : sub.frozen) {
    if (whole.mesh.twin(e) == kNone) continue;  // frozen in the whole mesh: nothing to join
    const VertexId a = numbers[whole.mesh.origin(e)], b = numbers[whole.mesh.target(e)];
    const EdgeRef twin = whole.mesh.twin(e);
    const bool is_cut = partition.piece_of[triOf(twin)] != kNone;
    cut.edges.push_back({a, b, std::min(e, twin), is_cut ? kNone : twin, whole.mesh.segment(e)});
  }
  std::ranges::sort(cut.edges, {}, [](const CutEdge& e) { return std::pair(e.a, e.b); });
  const auto own = sub.parent.begin() + sub.mesh.input_vertices;
  cut.fixed.assign(sub.parent.begin(), own);
  cut.own.assign(own, sub.parent.end());
  if (!whole.due_vertices.empty())
    for (const VertexId v : sub.parent) cut.state.due_vertices.push_back(whole.due_vertices[v]);
  if (!whole.due_triangles.empty())
    for (const TriId t : triangles) cut.state.due_triangles.push_back(whole.due_triangles[t]);
  for (const VertexId v : sub.parent) numbers[v] = kNone;
  cut.state.mesh = std::move(sub.mesh);
  cut.state.notes = std::move(sub.notes);
  return cut;
}

}  // namespace coastmesh
