#include "apps/plot/mesh_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/quality.hpp"
#include "gis/elements/quads.hpp"

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

std::vector<std::uint32_t> partsOf(const TriMesh& mesh) {
  constexpr std::uint32_t kNoPart = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> parts(mesh.triangles.size(), kNoPart);
  std::uint32_t count = 0;
  std::vector<TriId> waiting;
  for (TriId first = 0; first < mesh.triangles.size(); ++first) {
    if (parts[first] != kNoPart) continue;
    parts[first] = count;
    waiting.push_back(first);
    while (!waiting.empty()) {
      const TriId t = waiting.back();
      waiting.pop_back();
      for (const EdgeRef twin : mesh.triangles[t].adj) {
        if (twin == kNone) continue;
        const TriId next = triOf(twin);
        if (parts[next] != kNoPart || mesh.regions[next] != mesh.regions[t]) continue;
        parts[next] = count;
        waiting.push_back(next);
      }
    }
    ++count;
  }
  return parts;
}

double shapeQuality(const Point& a, const Point& b, const Point& c) {
  const double squares = squaredDistance(a, b) + squaredDistance(b, c) + squaredDistance(c, a);
  return squares > 0.0 ? 4.0 * std::numbers::sqrt3 * std::abs(signedArea(a, b, c)) / squares : 0.0;
}

double QuadAngles::quality(std::size_t triangle) const {
  const auto sine = [](double degrees) { return std::sin(degrees * std::numbers::pi / 180.0); };
  // A sine falls from 90 degrees on both sides, so that one of the extreme angles has the smallest.
  if (greatest_deg[triangle] >= 180.0) return 0.0;
  return std::min(sine(least_deg[triangle]), sine(greatest_deg[triangle]));
}

QuadAngles quadAnglesOf(const Grid& grid) {
  QuadAngles angles;
  for (const Quad& quad : quadsOf(grid)) {
    if (angles.least_deg.empty())
      angles.least_deg.assign(grid.triangles.size(), std::numeric_limits<double>::quiet_NaN());
    if (angles.greatest_deg.empty()) angles.greatest_deg = angles.least_deg;
    const std::array<double, 4> own = anglesOf(grid, quad);
    for (const std::uint32_t t : quad.halves) {
      angles.least_deg[t] = std::ranges::min(own);
      angles.greatest_deg[t] = std::ranges::max(own);
    }
  }
  return angles;
}

}  // namespace coastmesh
