#include "gis/geometry/chain_index.hpp"

#include <cassert>

#include "core/predicates.hpp"

namespace coastmesh {

bool segmentsMeet(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (!Box::of(a, b).meets(Box::of(c, d))) return false;
  const int abc = orient2d(a, b, c), abd = orient2d(a, b, d);
  if (abc * abd > 0) return false;
  const int cda = orient2d(c, d, a), cdb = orient2d(c, d, b);
  // Collinear segments meet iff their boxes do.
  return cda * cdb <= 0;
}

void ChainIndex::add(std::span<const Point> chain) {
  if (chain.size() < 2) return;
  const auto number = static_cast<std::uint32_t>(chain_begin_.size());
  chain_begin_.push_back(points_.size());
  points_.insert(points_.end(), chain.begin(), chain.end());
  if (kind_ == Kind::Rings) points_.push_back(chain.front());
  chain_of_.insert(chain_of_.end(), points_.size() - chain_begin_.back() - 1, number);
}

void ChainIndex::build() {
  std::vector<Box> boxes(edgeCount());
  for (std::size_t e = 0; e < boxes.size(); ++e) boxes[e] = Box::of(start(e), end(e));
  tree_ = BoxTree(boxes, BoxTree::Order::Given);
}

Location ChainIndex::locate(const Point& p) const {
  assert(kind_ == Kind::Rings);
  // Counts the edges that a ray from p towards smaller x crosses; an edge includes its lower end, not its upper one.
  bool inside = false, boundary = false;
  const auto above = [&](const Point& q) { return q.y > p.y; };
  const auto enter = [&](const Box& box, std::size_t first, std::size_t last) {
    if (boundary || box.ymin > p.y || box.ymax < p.y || box.xmin > p.x) return false;
    if (box.xmax >= p.x) return true;
    // All edges of the node lie on the ray's side. The ray crosses a whole ring an even number of times, and a piece of
    // a ring as often, modulo 2, as the line between its ends.
    const std::uint32_t ring_a = chain_of_[first], ring_b = chain_of_[last - 1];
    bool crossed = above(start(first)) != above(end(last - 1));
    if (ring_a != ring_b) crossed ^= above(chainStart(ring_a)) != above(chainStart(ring_b));
    inside ^= crossed;
    return false;
  };
  const auto found = [&](std::uint32_t e) {
    const Point &a = start(e), &b = end(e);
    const int side = above(a) ? orient2d(b, a, p) : orient2d(a, b, p);
    if (side == 0 && Box::of(a, b).meets({p.x, p.y, p.x, p.y})) boundary = true;
    if (above(a) != above(b) && side < 0) inside = !inside;  // p lies to the right of the edge, taken upwards
  };
  tree_.descend(enter, found);
  return boundary ? Location::Boundary : inside ? Location::Inside : Location::Outside;
}

}  // namespace coastmesh
