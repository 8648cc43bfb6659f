#include "apps/plot/mesh_shape.hpp"

#include <cmath>
#include <numbers>

#include "core/quality.hpp"

namespace coastmesh {

std::vector<std::uint32_t> degreesInside(const TriMesh& mesh) {
  std::vector<std::uint32_t> degrees(mesh.points.size(), 0);
  for (const Triangle& triangle : mesh.triangles)
    for (const VertexId v : triangle.v) ++degrees[v];
  for (const Triangle& triangle : mesh.triangles)
    for (unsigned i = 0; i < 3; ++i)
      if (triangle.adj[i] == kNone) degrees[triangle.v[next3(i)]] = degrees[triangle.v[prev3(i)]] = 0;
  return degrees;
}

double shapeQuality(const Point& a, const Point& b, const Point& c) {
  const double squares = squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a);
  return squares > 0.0 ? 4.0 * std::numbers::sqrt3 * std::abs(signedArea(a, b, c)) / squares : 0.0;
}

}  // namespace coastmesh
