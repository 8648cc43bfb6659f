#include "gis/rules/area_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace coastmesh {
namespace {

constexpr std::size_t kWorthTree = 32;  // points
constexpr double kRounding = 1e-12;     // of coordinates: where a ray crosses an edge may be as far outside its box

}  // namespace

AreaSearch::SearchedRing::SearchedRing(Ring points) : ring(std::move(points)) {
  if (ring.size() < kWorthTree) return;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    boxes.push_back(Box::of(before(i), ring[i]));
    slack = std::max(slack, kRounding * std::abs(ring[i].x));
  }
  tree = BoxTree(boxes, BoxTree::Order::Given);
}

bool AreaSearch::SearchedRing::isCrossed(std::size_t edge, const Point& p) const {
  const Point &a = ring[edge], &b = before(edge);
  return (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
}

bool AreaSearch::SearchedRing::crossedOddly(const Point& p) const {
  bool odd = false;
  if (tree.size() == 0) {
    for (std::size_t i = 0; i < ring.size(); ++i) odd = odd != isCrossed(i, p);
    return odd;
  }
  const auto enter = [&](const Box& box, std::size_t first, std::size_t last) {
    if (box.ymin > p.y || box.ymax < p.y || box.xmax < p.x - slack) return false;
    if (box.xmin <= p.x + slack) return true;
    // All of this part lies to the east: it is crossed oddly if it ends on the other side of the ray.
    odd = odd != ((before(first).y > p.y) != (ring[last - 1].y > p.y));
    return false;
  };
  tree.descend(enter, [&](std::uint32_t i) { odd = odd != isCrossed(i, p); });
  return odd;
}

bool AreaSearch::SearchedRing::contains(const Point& p, const RulePlane& plane) const {
  return std::ranges::any_of(plane.turns(), [&](double turn) { return crossedOddly({p.x + turn, p.y}); });
}

AreaSearch::AreaSearch(Polygon polygon) {
  for (const Point& p : polygon.outer) box_.add(p);
  rings_.emplace_back(std::move(polygon.outer));
  for (Ring& hole : polygon.holes) rings_.emplace_back(std::move(hole));
}

bool AreaSearch::contains(const Point& p, const RulePlane& plane) const {
  bool inside = false;
  for (const SearchedRing& ring : rings_) inside = inside != ring.contains(p, plane);
  return inside;
}

}  // namespace coastmesh
