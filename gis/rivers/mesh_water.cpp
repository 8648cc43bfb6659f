#include "gis/rivers/mesh_water.hpp"

#include "core/metric.hpp"
#include "gis/fields/plain_field.hpp"

namespace coastmesh {

MeshWater::MeshWater(const Grid& grid, const RiverPlane& plane, const Box& near, const ItemLoop& loop)
    : grid_(grid), plane_(plane), triangles_(grid, near, loop) {
  const std::vector<std::uint8_t> land = landNodes(grid);
  land_.assign(land.begin(), land.end());
}

bool MeshWater::isLandAt(const Point& plane) const {
  const Point place = plane_.inverse(plane);
  return (land_.empty() ? triangles_.zAt(place) : triangles_.valueAt(land_, place)) > 0.0;
}

std::vector<std::pair<Point, Point>> MeshWater::shores() const {
  std::vector<std::pair<Point, Point>> edges;
  for (const auto& [a, b] : triangles_.boundaryEdges())
    edges.emplace_back(plane_.forward(grid_.nodes[a]), plane_.forward(grid_.nodes[b]));
  return edges;
}

std::optional<NearWater> MeshWater::nearest(const Point& plane, double reach) const {
  Box box;
  for (const double dx : {-reach, reach})
    for (const double dy : {-reach, reach}) box.add(plane_.inverse({plane.x + dx, plane.y + dy}));
  std::optional<NearWater> best;
  double least = reach;
  triangles_.visit(box, [&](std::uint32_t t) {
    const auto& v = grid_.triangles[t];
    for (unsigned k = 0; k < 3; ++k) {
      const Point a = plane_.forward(grid_.nodes[v[k]]), b = plane_.forward(grid_.nodes[v[(k + 1) % 3]]);
      const Point place = nearestOnSegment(plane, a, b);
      const double gap = distance(plane, place);
      if (!(gap <= least) || (best && gap == least && !lexLess(place, best->place))) continue;
      least = gap;
      const Point c = plane_.forward(grid_.nodes[v[(k + 2) % 3]]);
      best = NearWater{place, gap, distance(a, b), centroid(a, b, c)};
    }
  });
  return best;
}

}  // namespace coastmesh
