#include "core/shortfalls.hpp"

#include <algorithm>

#include "core/input_angle.hpp"
#include "core/quality.hpp"

namespace coastmesh {

std::vector<Shortfall> findShortfalls(const TriMesh& mesh, const RefineOptions& options) {
  const TriangleBound bound(options.min_angle_deg, options.max_angle_deg, options.size_max);
  return findShortfalls(mesh, bound, bound);
}

std::vector<Shortfall> findShortfalls(const TriMesh& mesh, const TriangleBound& asked, const TriangleBound& in_reach) {
  const std::vector<bool> explained = explainedTriangles(mesh, in_reach);
  std::vector<Shortfall> shortfalls;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    const Point &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    if (explained[t] || !isBad(a, b, c, asked)) continue;
    const auto [low, high] = std::ranges::minmax(anglesDeg(a, b, c));
    shortfalls.push_back({(1.0 / 3.0) * (a + b + c), low, high});
  }
  return shortfalls;
}

}  // namespace coastmesh
