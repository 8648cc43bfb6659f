#include "gis/shore/shore_frame.hpp"

#include "core/predicates.hpp"

namespace coastmesh {

ShoreFrame::ShoreFrame(const std::vector<std::pair<Point, Point>>& sides) : sides_(sides) {
  std::vector<Box> boxes;
  for (const auto& [from, to] : sides_) boxes.push_back(Box::of(from, to));
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

bool ShoreFrame::parts(const Point& a, const Point& b) const {
  bool odd = false;
  tree_.visit(Box::of(a, b), [&](std::uint32_t side) {
    const auto& [from, to] = sides_[side];
    // Half-open, so that a common end of two sides counts once.
    if ((orient2d(a, b, from) > 0) == (orient2d(a, b, to) > 0)) return;
    if (orient2d(from, to, a) * orient2d(from, to, b) < 0) odd = !odd;
  });
  return odd;
}

}  // namespace coastmesh
