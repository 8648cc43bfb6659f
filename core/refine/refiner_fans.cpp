#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/refine/refiner.hpp"

namespace coastmesh {

namespace {

// How far a fan is looked beyond, in triangles: a bound on the run, not a setting.
constexpr std::size_t kLongestStrip = 100000;

}  // namespace

VertexId Refiner::fanApexOf(TriId t) const {
  if (!mesh_.isLive(t)) return kNone;
  const Corners& v = mesh_.triangle(t).v;
  const auto apex = std::ranges::find_if(v, [&](VertexId corner) { return isFan(t, corner); });
  return apex == v.end() ? kNone : *apex;
}

std::vector<TriId> Refiner::shortStrip(TriId t) const {
  const VertexId apex = fanApexOf(t);
  if (apex == kNone) return {};
  const unsigned i = mesh_.cornerOf(t, apex);
  const SegmentId right = mesh_.segment(edgeRef(t, prev3(i))), left = mesh_.segment(edgeRef(t, next3(i)));
  std::vector<TriId> strip{t};
  std::size_t up_to_last = 0;
  EdgeRef across = edgeRef(t, i);
  while (strip.size() < kLongestStrip && !mesh_.isConstrained(across)) {
    // Its base is the edge shared with the one before, from the left side to the right one.
    const EdgeRef base = mesh_.twin(across);
    strip.push_back(triOf(base));
    if (violatesBound(triOf(base))) up_to_last = strip.size();
    const EdgeRef on_right = edgeRef(triOf(base), next3(indexOf(base)));
    const EdgeRef on_left = edgeRef(triOf(base), prev3(indexOf(base)));
    if (mesh_.segment(on_right) == right && right != kNone) {
      across = on_left;
    } else if (mesh_.segment(on_left) == left && left != kNone) {
      across = on_right;
    } else {
      break;
    }
  }
  strip.resize(up_to_last);
  return strip;
}

void Refiner::growFan(TriId fan, VertexId apex, Beyond beyond) {
  // Every round takes a vertex out.
  for (std::size_t left_of_strip = shortStrip(fan).size(); left_of_strip > 1; --left_of_strip) {
    const unsigned i = mesh_.cornerOf(fan, apex);
    const SegmentId right = mesh_.segment(edgeRef(fan, prev3(i))), left = mesh_.segment(edgeRef(fan, next3(i)));
    const VertexId a = mesh_.triangle(fan).v[next3(i)], b = mesh_.triangle(fan).v[prev3(i)];
    if (mesh_.isConstrained(edgeRef(fan, i))) return;
    const EdgeRef base = mesh_.twin(edgeRef(fan, i));
    const VertexId c = mesh_.apex(base);
    const bool on_right = mesh_.segment(edgeRef(triOf(base), next3(indexOf(base)))) == right;
    const bool on_left = mesh_.segment(edgeRef(triOf(base), prev3(indexOf(base)))) == left;
    if (!on_right && !on_left) return;
    const VertexId goes = on_right ? a : b, stays = on_right ? b : a;
    if (mesh_.kind(goes) != VertexKind::Segment) return;
    const Point &from = mesh_.point(apex), &to = mesh_.point(c);
    if (isTooLong(from, to, mesh_.point(stays), squaredDistance(from, to), bound_)) return;
    const std::size_t known = touched_.size();
    if (!(beyond == Beyond::StaysGood ? ops_.removeInto({apex, c, stays}, goes, touched_)
                                      : ops_.removeAnyway(goes, touched_)))
      return;
    ++stats_.removals;
    const auto grown =
        std::find_if(touched_.begin() + static_cast<std::ptrdiff_t>(known), touched_.end(), [&](TriId t) {
          const Corners& v = mesh_.triangle(t).v;
          const auto has = [&](VertexId corner) { return std::ranges::find(v, corner) != v.end(); };
          return mesh_.isLive(t) && has(apex) && has(c) && has(stays);
        });
    if (grown == touched_.end()) return;
    fan = *grown;
  }
}

void Refiner::growAllFans(Beyond beyond) {
  for (TriId t = 0; t < mesh_.triangleSlots(); ++t)
    if (const VertexId apex = fanApexOf(t); apex != kNone) growFan(t, apex, beyond);
}

void Refiner::growFans(Beyond beyond, const RunControl& control) {
  growAllFans(beyond);
  if (beyond == Beyond::GetsMended && !touched_.empty()) {
    enqueueTouched();
    drainQueue(control);
    // That may have split the sides again.
    growAllFans(beyond);
  }
  touched_.clear();
}

}  // namespace coastmesh
