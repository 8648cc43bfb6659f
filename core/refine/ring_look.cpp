#include "core/refine/ring_look.hpp"

#include <utility>

namespace coastmesh {

LookEdges& RingLook::edges(const EditMesh& mesh, const Frame& frame, const Ring& ring) {
  if (!std::exchange(has_edges_, true))
    edges_.takeLoop(ring.corners.size(), [&](std::size_t k) { return frame.to(mesh.point(ring.corners[k])); });
  return edges_;
}

PetalBox RingLook::box(const FeasibleRegion& region) { return has_boxes_ ? after_[0] : region.boxOf(edges_); }

void RingLook::prepareBoxes(const FeasibleRegion& region) {
  if (std::exchange(has_boxes_, true)) return;
  region.boxesOf(edges_, boxes_);
  const std::size_t count = boxes_.size();
  before_.resize(count + 1);
  after_.resize(count + 1);
  before_[0] = after_[count] = {};
  for (std::size_t k = 0; k < count; ++k) {
    before_[k + 1] = before_[k];
    before_[k + 1].cut(boxes_[k]);
  }
  for (std::size_t k = count; k-- > 0;) {
    after_[k] = after_[k + 1];
    after_[k].cut(boxes_[k]);
  }
}

PetalBox RingLook::boxWithout(std::size_t k) const {
  if (k + 1 < edges_.size()) {
    PetalBox box = before_[k];
    box.cut(after_[k + 2]);
    return box;
  }
  PetalBox box;
  for (std::size_t i = 1; i < k; ++i) box.cut(boxes_[i]);
  return box;
}

bool Fan::fit(LookEdges& link, const Point& place, const AngleBound& bound) {
  count_ = link.size();
  if (area_.size() < count_ + 2)
    for (std::vector<double>* values : {&at_x_, &at_y_, &at_place_, &area_}) values->resize(count_ + 2);
  double *at_x_of = at_x_.data() + 1, *at_y_of = at_y_.data() + 1, *at_place_of = at_place_.data() + 1;
  double* area_of = area_.data() + 1;
  for (const LookEdgePair& e : link.pairs()) {
    const DoublePair to_x = place.x - e.to_x, to_y = place.y - e.to_y;
    const DoublePair from_x = e.from_x - place.x, from_y = e.from_y - place.y;
    const DoublePair at_x = -(e.along_x * from_x + e.along_y * from_y), at_y = -(e.along_x * to_x + e.along_y * to_y);
    const DoublePair at_place = -(to_x * from_x + to_y * from_y), area = -(e.along_x * from_y - e.along_y * from_x);
    const auto fits = larger(larger(at_x, at_y), at_place) <= bound.cot_min * area;
    if ((fits[0] & fits[1]) == 0) return false;
    putPair(at_x_of, at_x);
    putPair(at_y_of, at_y);
    putPair(at_place_of, at_place);
    putPair(area_of, area);
    at_x_of += 2;
    at_y_of += 2;
    at_place_of += 2;
    area_of += 2;
  }
  return true;
}

bool Fan::spokesAreDelaunay() {
  constexpr double kRounding = 1e-14;
  at_x_[0] = at_x_[count_];
  area_[0] = area_[count_];
  // Beyond an odd number there is the last one again: its own two angles add up to less than a half turn.
  for (std::size_t k = 0; k < count_; k += 2) {
    const DoublePair before = pairAt(&area_[k]), area = pairAt(&area_[k + 1]);
    const DoublePair sum = pairAt(&at_x_[k]) * area + pairAt(&at_y_[k + 1]) * before;
    const auto clear = sum > kRounding * before * area;
    if ((clear[0] & clear[1]) == 0) return false;
  }
  return true;
}

}  // namespace coastmesh
