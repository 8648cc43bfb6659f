#include "gis/geometry/edges_below.hpp"

#include <algorithm>
#include <limits>

#include "core/predicates.hpp"

namespace coastmesh {

EdgesBelow::EdgesBelow(const std::vector<Point>& points, const std::vector<std::pair<VertexId, VertexId>>& edges)
    : points_(points), edges_(edges) {
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (const auto& [a, b] : edges) boxes.push_back(Box::of(points[a], points[b]));
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

std::pair<VertexId, VertexId> EdgesBelow::westToEast(std::uint32_t edge) const {
  const auto [a, b] = edges_[edge];
  return points_[a].x <= points_[b].x ? std::pair(a, b) : std::pair(b, a);
}

// True iff edge f runs above edge e where their ranges of x overlap.
bool EdgesBelow::isHigher(std::uint32_t f, std::uint32_t e) const {
  const auto [a, b] = westToEast(e);
  const auto [c, d] = westToEast(f);
  // They do not cross, so an end of one within the other's range of x decides.
  if (points_[c].x >= points_[a].x) {
    const int side = orient2d(points_[a], points_[b], points_[c]);
    if (side != 0) return side > 0;
    return orient2d(points_[a], points_[b], points_[d]) > 0;
  }
  const int side = orient2d(points_[c], points_[d], points_[a]);
  if (side != 0) return side < 0;
  return orient2d(points_[c], points_[d], points_[b]) < 0;
}

std::uint32_t EdgesBelow::at(const Point& place) const {
  std::uint32_t below = kNone;
  double least = -std::numeric_limits<double>::infinity();  // edges that end lower run below the one that was found
  const auto mayHold = [&](const Box& box, std::size_t, std::size_t) {
    return box.xmin <= place.x && place.x <= box.xmax && box.ymin <= place.y && box.ymax >= least;
  };
  tree_.descend(mayHold, [&](std::uint32_t e) {
    const auto [a, b] = westToEast(e);
    if (!(points_[a].x <= place.x && place.x < points_[b].x)) return;
    if (orient2d(points_[a], points_[b], place) < 0) return;  // above the place
    if (below != kNone && !isHigher(e, below)) return;
    below = e;
    least = std::min(points_[a].y, points_[b].y);
  });
  return below;
}

}  // namespace coastmesh
