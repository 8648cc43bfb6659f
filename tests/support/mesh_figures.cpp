#include "tests/support/mesh_figures.hpp"

#include "core/quality.hpp"

namespace coastmesh {

std::map<RegionId, double> areasByRegion(const TriMesh& mesh) {
  std::map<RegionId, double> areas;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    areas[mesh.regions[t]] += signedArea(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
  }
  return areas;
}

std::set<std::set<std::pair<double, double>>> trianglesByPlace(const TriMesh& mesh) {
  std::set<std::set<std::pair<double, double>>> all;
  for (const Triangle& t : mesh.triangles) {
    std::set<std::pair<double, double>> corners;
    for (const VertexId v : t.v) corners.insert({mesh.points[v].x, mesh.points[v].y});
    all.insert(corners);
  }
  return all;
}

TriMesh releasedCopy(EditMesh mesh) {
  TriMesh released = mesh.release();
  released.regions.assign(released.triangles.size(), 0);
  return released;
}

}  // namespace coastmesh
