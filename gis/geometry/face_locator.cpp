#include "gis/geometry/face_locator.hpp"

#include "core/predicates.hpp"

namespace coastmesh {

FaceLocator::FaceLocator(const PlanarMap& map, const std::vector<Point>& points,
                         const std::vector<std::pair<VertexId, VertexId>>& edges)
    : map_(map), points_(points), edges_(edges) {
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (const auto& [a, b] : edges) boxes.push_back(Box::of(points[a], points[b]));
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

std::uint32_t FaceLocator::faceAt(const Point& place) const {
  // Finds the edge straight below: the highest of those whose half-open range of x includes that of the place. The
  // range of a vertical edge is empty; the edges next to it are found instead.
  std::uint32_t below = kNone;
  Box ray{place.x, tree_.bounds().ymin, place.x, place.y};
  const auto westToEast = [&](std::uint32_t e) {
    const auto [a, b] = edges_[e];
    return points_[a].x <= points_[b].x ? std::pair(a, b) : std::pair(b, a);
  };
  // True iff edge f runs above edge e at the place's x.
  const auto higher = [&](std::uint32_t f, std::uint32_t e) {
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
  };
  tree_.visit(ray, [&](std::uint32_t e) {
    const auto [a, b] = westToEast(e);
    if (!(points_[a].x <= place.x && place.x < points_[b].x)) return;
    if (orient2d(points_[a], points_[b], place) < 0) return;  // above the place
    if (below == kNone || higher(e, below)) below = e;
  });
  if (below == kNone) return PlanarMap::kOuterFace;
  const bool along = westToEast(below).first == edges_[below].first;
  return map_.faceOf(2 * below + (along ? 0u : 1u));  // to the left of the edge, taken eastwards
}

}  // namespace coastmesh
