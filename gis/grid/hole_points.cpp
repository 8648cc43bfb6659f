#include "gis/grid/hole_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/triangulate/label_regions.hpp"
#include "gis/geometry/planar_map.hpp"

namespace coastmesh {

namespace {

class HoleFinder {
 public:
  HoleFinder(const Pslg& pslg, const PlanarMap& map) : pslg_(pslg), map_(map) {}

  // Follows straight lines across the face from the midpoints of its five longest edges, and returns the middle of the
  // longest line.
  Point pointIn(std::uint32_t face) const {
    constexpr std::size_t kTries = 5;
    std::vector<PlanarMap::HalfEdge> boundary(map_.around(face).begin(), map_.around(face).end());
    const std::size_t tries = std::min(kTries, boundary.size());
    std::partial_sort(boundary.begin(), boundary.begin() + static_cast<std::ptrdiff_t>(tries), boundary.end(),
                      [&](auto g, auto h) { return lengthOf(g) > lengthOf(h); });
    Point best{};
    double best_width = -1;
    for (std::size_t i = 0; i < tries; ++i) {
      const Point &a = tail(boundary[i]), &b = head(boundary[i]);
      const Point middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
      const double length = lengthOf(boundary[i]);
      const Point across{(a.y - b.y) / length, (b.x - a.x) / length};
      const double width = widthAcross(face, boundary[i], middle, across);
      if (width <= best_width) continue;
      best_width = width;
      best = {middle.x + across.x * width / 2, middle.y + across.y * width / 2};
    }
    return best;
  }

 private:
  const Point& tail(PlanarMap::HalfEdge h) const {
    const Segment& s = pslg_.segments[h / 2];
    return pslg_.points[h % 2 == 0 ? s.a : s.b];
  }
  const Point& head(PlanarMap::HalfEdge h) const { return tail(h ^ 1u); }
  double lengthOf(PlanarMap::HalfEdge h) const { return std::hypot(head(h).x - tail(h).x, head(h).y - tail(h).y); }

  // The length of the ray from `from` in the direction `across` to the next other edge of the face; infinite if there
  // is none.
  double widthAcross(std::uint32_t face, PlanarMap::HalfEdge own, const Point& from, const Point& across) const {
    double width = std::numeric_limits<double>::infinity();
    for (const PlanarMap::HalfEdge h : map_.around(face)) {
      if (h == own) continue;
      const Point p{tail(h).x - from.x, tail(h).y - from.y}, q{head(h).x - from.x, head(h).y - from.y};
      const double beside_p = across.x * p.y - across.y * p.x, beside_q = across.x * q.y - across.y * q.x;
      if ((beside_p > 0) == (beside_q > 0)) continue;
      const double t = beside_p / (beside_p - beside_q);
      const double along = (p.x + t * (q.x - p.x)) * across.x + (p.y + t * (q.y - p.y)) * across.y;
      if (along > 0) width = std::min(width, along);
    }
    return width;
  }

  const Pslg& pslg_;
  const PlanarMap& map_;
};

}  // namespace

std::vector<Point> holePoints(const Pslg& pslg) {
  if (!hasRegions(pslg)) return {};
  std::vector<std::pair<VertexId, VertexId>> edges;
  edges.reserve(pslg.segments.size());
  for (const Segment& s : pslg.segments) edges.emplace_back(s.a, s.b);
  const PlanarMap map(pslg.points, edges);
  const HoleFinder finder(pslg, map);
  std::vector<Point> points;
  for (std::uint32_t face = PlanarMap::kOuterFace + 1; face < map.faceCount(); ++face) {
    const PlanarMap::HalfEdge h = map.around(face).front();
    const Segment& s = pslg.segments[h / 2];
    if ((h % 2 == 0 ? s.left : s.right) == kOutside) points.push_back(finder.pointIn(face));
  }
  return points;
}

}  // namespace coastmesh
