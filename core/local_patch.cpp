#include "core/local_patch.hpp"

#include <algorithm>
#include <unordered_map>

namespace coastmesh {

std::vector<TriId> trianglesAround(const EditMesh& mesh, std::span<const TriId> centre, unsigned rings) {
  std::vector<TriId> patch(centre.begin(), centre.end());
  std::vector<EdgeRef> star;
  std::size_t done = 0;
  for (unsigned ring = 0; ring < rings; ++ring) {
    const std::size_t end = patch.size();
    for (; done < end; ++done) {
      for (const VertexId v : mesh.triangle(patch[done]).v) {
        mesh.star(v, star);
        for (const EdgeRef e : star) patch.push_back(triOf(e));
      }
    }
    // Keep those that are new, in order.
    std::sort(patch.begin() + static_cast<std::ptrdiff_t>(end), patch.end());
    patch.erase(std::unique(patch.begin() + static_cast<std::ptrdiff_t>(end), patch.end()), patch.end());
    std::vector<TriId> known(patch.begin(), patch.begin() + static_cast<std::ptrdiff_t>(end));
    std::ranges::sort(known);
    const auto fresh = std::remove_if(patch.begin() + static_cast<std::ptrdiff_t>(end), patch.end(),
                                      [&](TriId t) { return std::ranges::binary_search(known, t); });
    patch.erase(fresh, patch.end());
  }
  return patch;
}

LocalPatch extractPatch(const EditMesh& parent, const VertexNotes& notes, std::span<const TriId> centre,
                        unsigned rings) {
  LocalPatch patch;
  patch.triangles = trianglesAround(parent, centre, rings);
  std::unordered_map<TriId, TriId> local_triangle;
  for (TriId i = 0; i < patch.triangles.size(); ++i) local_triangle.emplace(patch.triangles[i], i);

  // Vertices that must not change come first.
  std::unordered_map<VertexId, VertexId> local_vertex;
  const auto number = [&](VertexId v) {
    if (local_vertex.emplace(v, static_cast<VertexId>(patch.parent.size())).second) patch.parent.push_back(v);
  };
  for (const TriId t : patch.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (parent.kind(parent.triangle(t).v[i]) == VertexKind::Input) number(parent.triangle(t).v[i]);
      const EdgeRef twin = parent.twin(e);
      if (twin == kNone || local_triangle.contains(triOf(twin))) continue;
      number(parent.origin(e));
      number(parent.target(e));
      patch.frozen.push_back({parent.origin(e), parent.target(e), twin, parent.segment(e)});
    }
  }
  patch.mesh.input_vertices = static_cast<VertexId>(patch.parent.size());
  for (const TriId t : patch.triangles)
    for (const VertexId v : parent.triangle(t).v) number(v);

  patch.notes.corners = notes.corners;
  for (const VertexId v : patch.parent) {
    patch.mesh.points.push_back(parent.point(v));
    patch.notes.spacing.push_back(notes.spacing[v]);
  }
  for (VertexId v = 0; v < patch.mesh.input_vertices; ++v) {
    const VertexId own = patch.parent[v];
    const bool input = own < parent.inputVertices();
    patch.notes.shell_unit.push_back(input ? notes.shell_unit[own] : 0.0);
    patch.notes.small_angle.push_back(input && notes.small_angle[own]);
  }
  for (const TriId t : patch.triangles) {
    const Triangle& from = parent.triangle(t);
    Triangle& to = patch.mesh.triangles.emplace_back();
    for (unsigned i = 0; i < 3; ++i) {
      to.v[i] = local_vertex.at(from.v[i]);
      to.seg[i] = from.seg[i];
      if (from.adj[i] == kNone) continue;
      const auto beyond = local_triangle.find(triOf(from.adj[i]));
      if (beyond != local_triangle.end()) {
        to.adj[i] = edgeRef(beyond->second, indexOf(from.adj[i]));
      } else {
        to.seg[i] = kFrozen;
      }
    }
  }
  return patch;
}

void putBack(EditMesh& parent, const LocalPatch& patch, const TriMesh& solved, std::vector<VertexId>& added,
             std::vector<TriId>& touched) {
  std::vector<bool> on_segment(solved.points.size(), false);
  for (TriId t = 0; t < solved.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      if (solved.triangles[t].seg[i] == kNone) continue;
      on_segment[solved.origin(edgeRef(t, i))] = on_segment[solved.target(edgeRef(t, i))] = true;
    }
  }
  const auto fixed_end = patch.parent.begin() + patch.mesh.input_vertices;
  std::vector<VertexId> number(patch.parent.begin(), fixed_end);
  const std::vector<VertexId> gone(fixed_end, patch.parent.end());
  for (VertexId v = patch.mesh.input_vertices; v < solved.points.size(); ++v) {
    number.push_back(parent.addVertex(solved.points[v], on_segment[v] ? VertexKind::Segment : VertexKind::Free));
    added.push_back(number.back());
  }

  Patch hole{patch.triangles, patch.frozen};
  std::vector<RimEdge> inner;
  std::vector<Corners> fresh;
  for (TriId t = 0; t < solved.triangles.size(); ++t) {
    const Triangle& tri = solved.triangles[t];
    fresh.push_back({number[tri.v[0]], number[tri.v[1]], number[tri.v[2]]});
    for (unsigned i = 0; i < 3; ++i) {
      // A rim without segments is the rim of a mesh of points alone.
      if (tri.seg[i] == kFrozen || (tri.seg[i] == kNone && tri.adj[i] != kNone)) continue;
      const EdgeRef e = edgeRef(t, i);
      const RimEdge edge{number[solved.origin(e)], number[solved.target(e)], kNone, tri.seg[i]};
      (tri.adj[i] == kNone ? hole.rim : inner).push_back(edge);
    }
  }
  parent.replace(hole, fresh, gone, touched, inner);
}

}  // namespace coastmesh
