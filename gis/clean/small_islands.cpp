#include "gis/clean/small_islands.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "gis/coast/turned_rings.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

namespace {

// Islands that were taken out.
class TakenOut {
 public:
  explicit TakenOut(bool may_jump) : may_jump_(may_jump) {}

  void add(const Ring& ring) {
    if (!may_jump_) return index_.add(ring);
    for (const Ring& turned : turnedRings(ring)) index_.add(turned);
  }
  void build() { index_.build(); }

  // True if the ring lies in one of them. It may touch their shores, but not cross them.
  bool hold(const Ring& ring) const {
    for (const Point& p : ring) {
      const Location location = index_.locate(p);
      if (location != Location::Boundary) return location == Location::Inside;
    }
    return true;
  }

 private:
  bool may_jump_;
  ChainIndex index_{ChainIndex::Kind::Rings};
};

}  // namespace

std::vector<Polygon> SmallIslands::without(const Feature& feature,
                                           const std::function<void(const Point&)>& drop) const {
  switch (feature.use) {
    case FeatureUse::Land:
    case FeatureUse::Coast:
      return withoutLand(feature, drop);
    case FeatureUse::Area:
      return withoutHoles(feature, drop);
    default:
      return feature.polygons;
  }
}

std::vector<Polygon> SmallIslands::withoutLand(const Feature& feature,
                                               const std::function<void(const Point&)>& drop) const {
  std::vector<Polygon> kept;
  for (const Polygon& polygon : feature.polygons) {
    if (polygon.isOuterCut() || !isSmall(polygon.outer)) {
      kept.push_back(polygon);
    } else {
      drop(polygon.outer.front());
    }
  }
  return kept;
}

std::vector<Polygon> SmallIslands::withoutHoles(const Feature& feature,
                                                const std::function<void(const Point&)>& drop) const {
  std::vector<Polygon> kept;
  TakenOut taken_out(geographic_);
  bool any = false;
  for (const Polygon& polygon : feature.polygons) {
    Polygon& larger = kept.emplace_back();
    larger.outer = polygon.outer;
    for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
      const Ring& hole = polygon.holes[h];
      if (polygon.isHoleCut(h) || !isSmall(hole)) {
        larger.holes.push_back(hole);
        continue;
      }
      drop(hole.front());
      taken_out.add(hole);
      any = true;
    }
  }
  if (!any || kept.size() == 1) return kept;
  taken_out.build();
  std::erase_if(kept, [&](const Polygon& polygon) { return isSmall(polygon.outer) && taken_out.hold(polygon.outer); });
  return kept;
}

}  // namespace coastmesh
