#include "gis/rivers/mesh_water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

Box boxOf(const Grid& grid, std::uint32_t t) {
  Box box;
  for (const std::uint32_t v : grid.triangles[t]) box.add(grid.nodes[v]);
  return box;
}

Point nearestOnSegment(const Point& p, const Point& a, const Point& b) {
  return a + std::clamp(dot(p - a, b - a) / squaredDistance(a, b), 0.0, 1.0) * (b - a);
}

}  // namespace

MeshWater::MeshWater(const Grid& grid, const RiverPlane& plane, const Box& near, const ItemLoop& loop)
    : grid_(grid), plane_(plane) {
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    const Box box = boxOf(grid, t);
    if (!box.meets(near)) continue;
    triangles_.push_back(t);
    boxes.push_back(box);
  }
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
}

std::optional<std::uint32_t> MeshWater::triangleAt(const Point& place) const {
  std::optional<std::uint32_t> found;
  tree_.visit(Box::of(place, place), [&](std::uint32_t i) {
    const auto& v = grid_.triangles[triangles_[i]];
    const Point &a = grid_.nodes[v[0]], &b = grid_.nodes[v[1]], &c = grid_.nodes[v[2]];
    const int turn = orient2d(a, b, c);
    const auto isWithin = [&](const Point& p, const Point& q) { return orient2d(p, q, place) * turn >= 0; };
    if (turn != 0 && isWithin(a, b) && isWithin(b, c) && isWithin(c, a))
      found = std::min(found.value_or(triangles_[i]), triangles_[i]);
  });
  return found;
}

double MeshWater::zAt(const Point& plane) const {
  const Point place = plane_.inverse(plane);
  const auto t = triangleAt(place);
  if (!t || grid_.z.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto& v = grid_.triangles[*t];
  const Point &a = grid_.nodes[v[0]], &b = grid_.nodes[v[1]], &c = grid_.nodes[v[2]];
  const double whole = cross(b - a, c - a);
  const double of_a = cross(b - place, c - place) / whole, of_b = cross(c - place, a - place) / whole;
  return of_a * grid_.z[v[0]] + of_b * grid_.z[v[1]] + (1.0 - of_a - of_b) * grid_.z[v[2]];
}

std::optional<Point> MeshWater::nearest(const Point& plane, double reach) const {
  Box box;
  for (const double dx : {-reach, reach})
    for (const double dy : {-reach, reach}) box.add(plane_.inverse({plane.x + dx, plane.y + dy}));
  std::optional<Point> best;
  double least = reach;
  tree_.visit(box, [&](std::uint32_t i) {
    const auto& v = grid_.triangles[triangles_[i]];
    for (unsigned k = 0; k < 3; ++k) {
      const Point a = plane_.forward(grid_.nodes[v[k]]), b = plane_.forward(grid_.nodes[v[(k + 1) % 3]]);
      const Point place = nearestOnSegment(plane, a, b);
      const double gap = distance(plane, place);
      if (!(gap <= least) || (best && gap == least && !lexLess(place, *best))) continue;
      least = gap;
      best = place;
    }
  });
  return best;
}

}  // namespace coastmesh
