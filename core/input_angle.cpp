#include "core/input_angle.hpp"

#include <numbers>

namespace coastmesh {

std::vector<bool> explainedTriangles(const TriMesh& mesh, const TriangleBound& bound) {
  std::vector<bool> explained(mesh.triangles.size(), false);
  std::vector<TriId> first_ring;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      // Only at input vertices do segments meet at an angle.
      if (mesh.input_vertices != 0 && mesh.triangles[t].v[i] >= mesh.input_vertices) continue;
      const double here = angleAt(mesh.points[mesh.triangles[t].v[i]], mesh.points[mesh.triangles[t].v[next3(i)]],
                                  mesh.points[mesh.triangles[t].v[prev3(i)]]);
      // Without a largest angle a sector that holds one good angle can be divided.
      if (bound.max_angle >= std::numbers::pi && here >= bound.min_angle) continue;
      const Sector sector = sectorAt(mesh, t, i);
      if (sector.right == kNone || bound.canDivide(sector.angle)) continue;
      explained[t] = true;
      first_ring.push_back(t);
      break;
    }
  }
  for (const TriId t : first_ring)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh.triangles[t].adj[i] != kNone) explained[triOf(mesh.triangles[t].adj[i])] = true;
  return explained;
}

}  // namespace coastmesh
