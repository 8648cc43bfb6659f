#include "gis/clean/areas_within.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "gis/coast/turned_rings.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

namespace {

constexpr std::array kTurns{0.0, -360.0, 360.0};  // degrees

// Rings of a hole, at all turns at which its longitudes lie.
class HoleRings {
 public:
  HoleRings(const Ring& hole, bool geographic) {
    if (!geographic) {
      index_.add(hole);
    } else {
      for (const Ring& turned : turnedRings(hole)) index_.add(turned);
    }
    index_.build();
  }

  // True if the ring lies within. It may run along the hole.
  bool hold(const Ring& ring, double turn) const {
    bool touches = true;
    for (const Point& p : ring) {
      const Location location = index_.locate({p.x + turn, p.y});
      if (location == Location::Outside) return false;
      touches = touches && location == Location::Boundary;
    }
    if (!touches) return true;
    // All points are the hole's: the ring fills it, unless an edge leaves it.
    return std::ranges::none_of(ring, [&](const Point& p) {
      const Point& next = &p == &ring.back() ? ring.front() : *(&p + 1);
      return index_.locate({(p.x + next.x) / 2 + turn, (p.y + next.y) / 2}) == Location::Outside;
    });
  }

  Box bounds() const { return index_.bounds(); }

 private:
  ChainIndex index_{ChainIndex::Kind::Rings};
};

}  // namespace

AreasWithin::AreasWithin(const Coastline& coastline) {
  for (std::uint32_t f = 0; f < coastline.features.size(); ++f) {
    const Feature& feature = coastline.features[f];
    if (feature.use != FeatureUse::Area) continue;
    for (std::uint32_t p = 0; p < feature.polygons.size(); ++p) {
      Box box;
      for (const Point& point : feature.polygons[p].outer) box.add(point);
      if (box.empty()) continue;
      polygons_.emplace_back(f, p);
      boxes_.push_back(box);
    }
  }
  tree_ = BoxTree(boxes_, BoxTree::Order::Hilbert);
}

bool AreasWithin::any(const Coastline& coastline, const Ring& hole, std::size_t owner) const {
  const bool geographic = coastline.crs.geographic;
  std::optional<HoleRings> rings;
  Box box;
  for (const Point& p : hole) box.add(p);
  const bool jumps = geographic && longitudesJump(hole);
  if (jumps) box = rings.emplace(hole, geographic).bounds();
  bool found = false;
  for (const double turn : kTurns) {
    if (turn != 0.0 && !geographic) break;
    const Box around{box.xmin - turn, box.ymin, box.xmax - turn, box.ymax};
    tree_.visit(around, [&](std::uint32_t i) {
      const auto& [feature, polygon] = polygons_[i];
      // Only what is no larger than the hole is looked at point by point.
      if (found || feature == owner || !around.contains(boxes_[i])) return;
      if (!rings) rings.emplace(hole, geographic);
      found = rings->hold(coastline.features[feature].polygons[polygon].outer, turn);
    });
  }
  return found;
}

}  // namespace coastmesh
