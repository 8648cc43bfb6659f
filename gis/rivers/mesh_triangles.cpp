#include "gis/rivers/mesh_triangles.hpp"

#include <algorithm>
#include <limits>

#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

MeshTriangles::MeshTriangles(const Grid& grid, const Box& near, const ItemLoop& loop) : grid_(grid) {
  std::vector<Box> boxes;
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    Box box;
    for (const std::uint32_t v : grid.triangles[t]) box.add(grid.nodes[v]);
    if (!box.meets(near)) continue;
    triangles_.push_back(t);
    boxes.push_back(box);
  }
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
}

std::optional<std::uint32_t> MeshTriangles::at(const Point& place) const {
  std::optional<std::uint32_t> found;
  visit(Box::of(place, place), [&](std::uint32_t t) {
    const auto& v = grid_.triangles[t];
    const Point &a = grid_.nodes[v[0]], &b = grid_.nodes[v[1]], &c = grid_.nodes[v[2]];
    const int turn = orient2d(a, b, c);
    const auto isWithin = [&](const Point& p, const Point& q) { return orient2d(p, q, place) * turn >= 0; };
    if (turn != 0 && isWithin(a, b) && isWithin(b, c) && isWithin(c, a)) found = std::min(found.value_or(t), t);
  });
  return found;
}

std::vector<NodePair> MeshTriangles::boundaryEdges() const {
  std::vector<NodePair> edges;
  for (const std::uint32_t t : triangles_) {
    const auto& v = grid_.triangles[t];
    for (unsigned i = 0; i < 3; ++i) edges.push_back(edgeKey(v[i], v[(i + 1) % 3]));
  }
  std::ranges::sort(edges);
  std::vector<NodePair> single;
  for (std::size_t i = 0; i < edges.size(); ++i)
    if ((i == 0 || edges[i - 1] != edges[i]) && (i + 1 == edges.size() || edges[i + 1] != edges[i]))
      single.push_back(edges[i]);
  return single;
}

double MeshTriangles::valueAt(const std::vector<double>& values, const Point& place) const {
  const auto t = values.empty() ? std::nullopt : at(place);
  if (!t) return std::numeric_limits<double>::quiet_NaN();
  const auto& v = grid_.triangles[*t];
  const Point &a = grid_.nodes[v[0]], &b = grid_.nodes[v[1]], &c = grid_.nodes[v[2]];
  const double whole = cross(b - a, c - a);
  const double of_a = cross(b - place, c - place) / whole, of_b = cross(c - place, a - place) / whole;
  return of_a * values[v[0]] + of_b * values[v[1]] + (1.0 - of_a - of_b) * values[v[2]];
}

}  // namespace coastmesh
