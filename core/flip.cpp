#include "core/flip.hpp"

#include "core/predicates.hpp"

namespace coastmesh {

bool flipEdge(std::span<const Point> points, std::span<Triangle> triangles, EdgeRef e) {
  const TriId t = triOf(e);
  const unsigned i = indexOf(e);
  const EdgeRef f = triangles[t].adj[i];
  const TriId n = triOf(f);
  const unsigned j = indexOf(f);
  const VertexId a = triangles[t].v[i], b = triangles[t].v[next3(i)], c = triangles[t].v[prev3(i)];
  const VertexId d = triangles[n].v[j];
  if (orient2d(points[a], points[b], points[d]) <= 0 || orient2d(points[a], points[d], points[c]) <= 0) return false;
  struct Side {
    EdgeRef beyond;
    SegmentId seg;
  };
  const auto side = [&](TriId s, unsigned k) { return Side{triangles[s].adj[k], triangles[s].seg[k]}; };
  const Side ab = side(t, prev3(i)), ca = side(t, next3(i)), bd = side(n, next3(j)), dc = side(n, prev3(j));
  const auto link = [&](EdgeRef own, const Side& other) {
    triangles[triOf(own)].adj[indexOf(own)] = other.beyond;
    triangles[triOf(own)].seg[indexOf(own)] = other.seg;
    if (other.beyond == kNone) return;
    triangles[triOf(other.beyond)].adj[indexOf(other.beyond)] = own;
    triangles[triOf(other.beyond)].seg[indexOf(other.beyond)] = other.seg;
  };
  triangles[t].v = {a, b, d};
  triangles[n].v = {a, d, c};
  link(edgeRef(t, 0), bd);
  link(edgeRef(t, 2), ab);
  link(edgeRef(n, 0), dc);
  link(edgeRef(n, 1), ca);
  link(edgeRef(t, 1), {edgeRef(n, 2), kNone});
  return true;
}

bool flipToDelaunay(std::span<const Point> points, std::span<Triangle> triangles, EdgeRef e) {
  const auto& v = triangles[triOf(e)].v;
  const EdgeRef f = triangles[triOf(e)].adj[indexOf(e)];
  const VertexId beyond = triangles[triOf(f)].v[indexOf(f)];
  return inCircle(points[v[0]], points[v[1]], points[v[2]], points[beyond]) > 0 && flipEdge(points, triangles, e);
}

std::vector<TriId> restoreDelaunay(TriMesh& mesh, std::vector<EdgeRef> edges) {
  std::vector<TriId> changed;
  while (!edges.empty()) {
    const EdgeRef e = edges.back();
    edges.pop_back();
    if (mesh.segment(e) != kNone || mesh.twin(e) == kNone) continue;
    const TriId t = triOf(e), n = triOf(mesh.twin(e));
    if (!flipToDelaunay(mesh.points, mesh.triangles, e)) continue;
    changed.push_back(t);
    changed.push_back(n);
    for (const EdgeRef f : {edgeRef(t, 0), edgeRef(t, 2), edgeRef(n, 0), edgeRef(n, 1)}) edges.push_back(f);
  }
  return changed;
}

}  // namespace coastmesh
