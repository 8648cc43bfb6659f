#include "core/flip.hpp"

#include "core/links.hpp"
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
  triangles[t].v = {a, b, d};
  triangles[n].v = {a, d, c};
  link(triangles, edgeRef(t, 0), bd.beyond, bd.seg);
  link(triangles, edgeRef(t, 2), ab.beyond, ab.seg);
  link(triangles, edgeRef(n, 0), dc.beyond, dc.seg);
  link(triangles, edgeRef(n, 1), ca.beyond, ca.seg);
  link(triangles, edgeRef(t, 1), edgeRef(n, 2), kNone);
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
  flipWaiting(
      mesh.points, mesh.triangles, edges, [&](EdgeRef e) { return mesh.segment(e) == kNone && mesh.twin(e) != kNone; },
      [&](TriId t, TriId n) {
        changed.push_back(t);
        changed.push_back(n);
      });
  return changed;
}

}  // namespace coastmesh
