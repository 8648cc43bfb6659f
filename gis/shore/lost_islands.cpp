#include "gis/shore/lost_islands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/chain_index.hpp"
#include "gis/geometry/ring_area.hpp"

namespace coastmesh {
namespace {

bool isShore(const Segment& s) { return (s.left == kOutside) != (s.right == kOutside); }

// The land on one side of the nearest shore to the east.
class ShoreLabels {
 public:
  ShoreLabels(const Pslg& pslg, const ItemLoop& loop) : pslg_(pslg) {
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < pslg.segments.size(); ++i) {
      if (!isShore(pslg.segments[i])) continue;
      shores_.push_back(i);
      boxes.push_back(Box::of(pslg.points[pslg.segments[i].a], pslg.points[pslg.segments[i].b]));
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert, loop);
  }

  // True if a shore is within the ring or meets it.
  bool reaches(const std::vector<Point>& ring) const {
    ChainIndex index(ChainIndex::Kind::Rings);
    index.add(ring);
    index.build();
    bool found = false;
    tree_.visit(index.bounds(), [&](std::uint32_t k) {
      const Point &a = pslg_.points[pslg_.segments[shores_[k]].a], &b = pslg_.points[pslg_.segments[shores_[k]].b];
      found = found || index.locate(a) == Location::Inside;
      index.visit(Box::of(a, b),
                  [&](std::size_t e) { found = found || segmentsMeet(a, b, index.start(e), index.end(e)); });
    });
    return found;
  }

  bool isWater(const Point& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    bool is_water = false;
    tree_.visit({p.x, p.y, std::numeric_limits<double>::infinity(), p.y}, [&](std::uint32_t k) {
      const Segment& s = pslg_.segments[shores_[k]];
      const Point *low = &pslg_.points[s.a], *high = &pslg_.points[s.b];
      const bool is_up = low->y <= high->y;
      if (!is_up) std::swap(low, high);
      if (!(low->y <= p.y && p.y < high->y) || orient2d(*low, *high, p) <= 0) return;
      const double at = low->x + (high->x - low->x) * (p.y - low->y) / (high->y - low->y);
      if (at >= nearest) return;
      nearest = at;
      is_water = (is_up ? s.left : s.right) != kOutside;  // the place is to the left of the way up
    });
    return is_water;
  }

 private:
  const Pslg& pslg_;
  std::vector<std::uint32_t> shores_;
  BoxTree tree_;
};

// The middle of the triangle within the ring with the largest inscribed circle; nullopt for a ring that crosses itself.
std::optional<Point> widestPlace(const std::vector<Point>& ring) {
  Pslg pslg;
  pslg.points = ring;
  const auto n = static_cast<VertexId>(ring.size());
  for (VertexId i = 0; i < n; ++i) pslg.segments.push_back({i, (i + 1) % n});
  try {
    const TriMesh mesh = constrainedDelaunay(pslg);
    double widest = 0.0;
    std::optional<Point> place;
    for (const Triangle& t : mesh.triangles) {
      const Point &a = mesh.point(t.v[0]), &b = mesh.point(t.v[1]), &c = mesh.point(t.v[2]);
      const double radius = cross(b - a, c - a) / (distance(a, b) + distance(b, c) + distance(c, a));
      if (radius <= widest) continue;
      widest = radius;
      place = centroid(a, b, c);
    }
    return place;
  } catch (const BadPslg&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<IslandRing> islandRings(const Pslg& pslg) {
  std::vector<std::pair<VertexId, VertexId>> edges;  // with the water to the left
  for (const Segment& s : pslg.segments)
    if (isShore(s)) edges.push_back(s.right == kOutside ? std::pair(s.a, s.b) : std::pair(s.b, s.a));
  std::ranges::sort(edges);
  std::vector<std::uint8_t> seen(edges.size(), 0);
  const auto firstFrom = [&](VertexId v) {
    auto at = std::ranges::lower_bound(edges, std::pair(v, VertexId{0}));
    while (at != edges.end() && at->first == v && seen[static_cast<std::size_t>(at - edges.begin())] != 0) ++at;
    return at != edges.end() && at->first == v ? static_cast<std::size_t>(at - edges.begin()) : edges.size();
  };
  std::vector<IslandRing> islands;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    IslandRing ring;
    for (std::size_t e = first; e < edges.size() && seen[e] == 0; e = firstFrom(edges[e].second)) {
      seen[e] = 1;
      ring.points.push_back(pslg.points[edges[e].first]);
    }
    if (ring.points.size() < 3) continue;
    ring.area = -signedAreaOf(ring.points);
    if (ring.area > 0.0) islands.push_back(std::move(ring));
  }
  return islands;
}

std::vector<LostIsland> lostIslands(const std::vector<IslandRing>& before, const Pslg& after, const SizeFunction& size,
                                    const ScaleTable& scales, double elements, const ItemLoop& loop) {
  static const double kElement = 0.25 * std::sqrt(3.0);  // the area of one with edges of 1
  const auto areaOnGround = [&](const IslandRing& island) {
    const double scale = scales.at(island.points.front());
    return island.area / scale / scale;
  };
  std::vector<const IslandRing*> large;
  for (const IslandRing& island : before) {
    const Point& p = island.points.front();
    const double size_m = size.at(p) / scales.measureAt(p);
    if (areaOnGround(island) >= elements * kElement * size_m * size_m) large.push_back(&island);
  }
  std::vector<LostIsland> lost;
  if (large.empty()) return lost;
  const ShoreLabels labels(after, loop);
  for (const IslandRing* island : large)
    if (const std::optional<Point> place = widestPlace(island->points);
        place && labels.isWater(*place) && !labels.reaches(island->points))
      lost.push_back({*place, areaOnGround(*island)});
  return lost;
}

}  // namespace coastmesh
