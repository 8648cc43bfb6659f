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
  const std::span<const LookEdgePair> edges = link.pairs();
  if (pairs_.size() < edges.size()) pairs_.resize(edges.size());
  Pair* out = pairs_.data();
  for (const LookEdgePair& e : edges) {
    const DoublePair to_x = place.x - e.to_x, to_y = place.y - e.to_y;
    const DoublePair from_x = e.from_x - place.x, from_y = e.from_y - place.y;
    out->at_x = -(e.along_x * from_x + e.along_y * from_y);
    out->at_y = -(e.along_x * to_x + e.along_y * to_y);
    out->at_place = -(to_x * from_x + to_y * from_y);
    out->area = -(e.along_x * from_y - e.along_y * from_x);
    const auto fits = larger(larger(out->at_x, out->at_y), out->at_place) <= bound.cot_min * out->area;
    if ((fits[0] & fits[1]) == 0) return false;
    ++out;
  }
  return true;
}

}  // namespace coastmesh
