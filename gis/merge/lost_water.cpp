#include "gis/merge/lost_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/ring_area.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

namespace {

std::array<Point, 3> cornersOf(const Grid& grid, std::uint32_t t) {
  const auto& v = grid.triangles[t];
  return {grid.nodes[v[0]], grid.nodes[v[1]], grid.nodes[v[2]]};
}

// The area that two triangles have in common, by the half-planes of the second one's sides (Sutherland & Hodgman 1974).
double commonArea(const std::array<Point, 3>& one, std::array<Point, 3> other) {
  if (cross(other[1] - other[0], other[2] - other[0]) < 0.0) std::swap(other[1], other[2]);
  std::vector<Point> ring(one.begin(), one.end()), kept;
  for (unsigned i = 0; i < 3 && !ring.empty(); ++i) {
    const Point &a = other[i], &b = other[(i + 1) % 3];
    const auto leftOf = [&](const Point& p) { return cross(b - a, p - a); };
    kept.clear();
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Point &p = ring[k], &q = ring[(k + 1) % ring.size()];
      const double at_p = leftOf(p), at_q = leftOf(q);
      if (at_p >= 0.0) kept.push_back(p);
      if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
        kept.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
    std::swap(ring, kept);
  }
  return ring.size() < 3 ? 0.0 : std::abs(signedAreaOf(ring));
}

}  // namespace

LostWater lostWater(const Grid& before, const Grid& now, std::span<const std::uint32_t> triangles,
                    const NestPlane* plane, const ItemLoop& loop) {
  if (before.triangles.empty()) return {};
  const auto inPlane = [&](const Grid& grid, std::uint32_t t) {
    std::array<Point, 3> corners = cornersOf(grid, t);
    if (plane != nullptr)
      for (Point& corner : corners) corner = plane->forward(corner);
    return corners;
  };
  Box around;
  for (std::uint32_t t = 0; t < before.triangles.size(); ++t)
    for (const Point& p : inPlane(before, t)) around.add(p);
  std::vector<std::uint32_t> near;
  std::vector<Box> boxes;
  for (const std::uint32_t t : triangles) {
    Box box;
    for (const Point& p : inPlane(now, t)) box.add(p);
    if (!box.meets(around)) continue;
    near.push_back(t);
    boxes.push_back(box);
  }
  const BoxTree tree(boxes, BoxTree::Order::Hilbert, loop);
  std::vector<double> lost(before.triangles.size(), 0.0);
  forEachByStretches(loop, lost.size(), [&](std::size_t i) {
    const std::array<Point, 3> corners = inPlane(before, static_cast<std::uint32_t>(i));
    const double area = 0.5 * std::abs(cross(corners[1] - corners[0], corners[2] - corners[0]));
    if (!(area > 0.0)) return;
    Box box;
    for (const Point& p : corners) box.add(p);
    double covered = 0.0;
    tree.visit(box, [&](std::uint32_t k) { covered += commonArea(corners, inPlane(now, near[k])); });
    const double share = std::max(0.0, 1.0 - covered / area);
    std::array<Point, 3> ground = cornersOf(before, static_cast<std::uint32_t>(i));
    flattenLocally(before.crs, ground);
    lost[i] = share * 0.5 * std::abs(cross(ground[1] - ground[0], ground[2] - ground[0]));
  });
  LostWater all;
  for (std::uint32_t t = 0; t < lost.size(); ++t) {
    all.area_m2 += lost[t];
    if (lost[t] <= all.largest_m2) continue;
    all.largest_m2 = lost[t];
    all.place = meanPlace(before.crs, cornersOf(before, t));
  }
  return all;
}

}  // namespace coastmesh
