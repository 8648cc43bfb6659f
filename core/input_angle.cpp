#include "core/input_angle.hpp"

#include <numbers>

namespace coastmesh {

bool mayBeSmall(const TriMesh& mesh, TriId t, unsigned i, const TriangleBound& bound) {
  if (bound.max_angle < std::numbers::pi) return true;
  const VertexId v = mesh.triangle(t).v[i];
  const Point along = mesh.point(mesh.triangle(t).v[next3(i)]) - mesh.point(v);
  while (true) {
    const unsigned c = mesh.cornerOf(t, v);
    if (dot(along, mesh.point(mesh.triangle(t).v[prev3(c)]) - mesh.point(v)) <= 0.0) return false;
    const EdgeRef in = edgeRef(t, next3(c));
    if (mesh.segment(in) != kNone || mesh.twin(in) == kNone) return true;
    t = triOf(mesh.twin(in));
  }
}

std::vector<bool> explainedTriangles(const TriMesh& mesh, const TriangleBound& bound) {
  std::vector<bool> explained(mesh.triangles.size(), false);
  std::vector<TriId> first_ring;
  // Every sector once, from its right side.
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId v = mesh.triangles[t].v[i];
      const EdgeRef right = edgeRef(t, prev3(i));
      if (mesh.segment(right) == kNone && mesh.twin(right) != kNone) continue;
      // Only at input vertices do segments meet at an angle.
      if (mesh.input_vertices != 0 && v >= mesh.input_vertices) continue;
      if (!mayBeSmall(mesh, t, i, bound)) continue;
      const Sector sector = sectorAt(mesh, t, i);
      if (bound.canDivide(sector.angle)) continue;
      TriId s = t;
      for (unsigned left = sector.triangles; left > 0; --left) {
        const unsigned c = mesh.cornerOf(s, v);
        const double here =
            angleAt(mesh.point(v), mesh.point(mesh.triangle(s).v[next3(c)]), mesh.point(mesh.triangle(s).v[prev3(c)]));
        // Without a largest angle a triangle whose own angle is good has no excuse here.
        if (bound.max_angle < std::numbers::pi || here < bound.min_angle) {
          explained[s] = true;
          first_ring.push_back(s);
        }
        if (left > 1) s = triOf(mesh.twin(edgeRef(s, next3(c))));
      }
    }
  }
  for (const TriId t : first_ring)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh.triangles[t].adj[i] != kNone) explained[triOf(mesh.triangles[t].adj[i])] = true;
  return explained;
}

}  // namespace coastmesh
