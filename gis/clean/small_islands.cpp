#include "gis/clean/small_islands.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>

#include "core/union_find.hpp"
#include "gis/coast/input_polygons.hpp"
#include "gis/coast/turned_rings.hpp"
#include "gis/geometry/box.hpp"
#include "gis/geometry/chain_index.hpp"
#include "gis/geometry/ring_area.hpp"

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

using PolygonId = std::pair<std::size_t, std::size_t>;  // a feature's index, its polygon's

bool isLand(const Feature& feature) { return feature.use == FeatureUse::Land || feature.use == FeatureUse::Coast; }

// Both ends of an edge, the same from both sides and, of longitudes, on both sides of the antimeridian.
using EdgeEnds = std::array<double, 4>;

EdgeEnds endsOf(Point a, Point b, bool geographic) {
  if (geographic) {
    for (Point* p : {&a, &b})
      if (p->x == -180) p->x = 180;
  }
  if (std::array{b.x, b.y} < std::array{a.x, a.y}) std::swap(a, b);
  return {a.x, a.y, b.x, b.y};
}

// Calls `visit(ends)` for each edge of a ring, but not for points that repeat.
template <typename Visit>
void forEdges(const Ring& ring, bool geographic, const Visit& visit) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[i + 1 == ring.size() ? 0 : i + 1];
    if (!(a == b)) visit(endsOf(a, b, geographic));
  }
}

// Small polygons of land, united where they share edges. Only edges of small polygons are stored, since large ones may
// have far more.
class SmallPieces {
 public:
  explicit SmallPieces(bool geographic) : geographic_(geographic) {}

  void add(PolygonId id, const Ring& ring, double area) {
    const auto piece = static_cast<std::uint32_t>(ids_.size());
    ids_.push_back(id);
    areas_.push_back(area);
    forEdges(ring, geographic_, [&](const EdgeEnds& ends) {
      const auto [found, is_new] = pieces_.try_emplace(ends, piece);
      if (!is_new) neighbours_.emplace_back(found->second, piece);
    });
  }
  // Adds a polygon that is not small, so that islands which share an edge with it are not small either.
  void joinLarge(const Ring& ring) {
    forEdges(ring, geographic_, [&](const EdgeEnds& ends) {
      const auto found = pieces_.find(ends);
      if (found != pieces_.end()) areas_[found->second] = std::numeric_limits<double>::infinity();
    });
  }
  bool has(const PolygonId& id) const { return std::ranges::binary_search(ids_, id); }

  // Those whose islands have less than `least` area.
  std::vector<PolygonId> ofSmallIslands(double least) const {
    UnionFind islands(ids_.size());
    for (const auto& [a, b] : neighbours_) islands.unite(a, b);
    std::vector<double> sums(ids_.size(), 0.0);
    for (std::uint32_t piece = 0; piece < ids_.size(); ++piece) sums[islands.find(piece)] += areas_[piece];
    std::vector<PolygonId> small;
    for (std::uint32_t piece = 0; piece < ids_.size(); ++piece)
      if (sums[islands.find(piece)] < least) small.push_back(ids_[piece]);
    return small;
  }

 private:
  bool geographic_;
  std::vector<PolygonId> ids_;  // ascending
  std::vector<double> areas_;
  std::map<EdgeEnds, std::uint32_t> pieces_;  // the first with an edge
  std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_;
};

constexpr std::array kTurns{0.0, -360.0, 360.0};  // degrees

// True if the place cannot lie within the ring, at any turn of longitudes.
bool isBeyond(const Ring& ring, const Point& place, bool geographic) {
  Box box;
  for (const Point& p : ring) box.add(p);
  if (!geographic) return !box.meets(Box::of(place, place));
  const bool may_jump = box.xmax - box.xmin > 180;
  return !may_jump && std::ranges::none_of(kTurns, [&](double turn) {
    const Point turned{place.x + turn, place.y};
    return box.meets(Box::of(turned, turned));
  });
}

// True if the polygon holds the place, at any turn of longitudes.
bool holds(const Polygon& polygon, const Point& place, bool geographic) {
  if (isBeyond(polygon.outer, place, geographic)) return false;
  const InputPolygons rings({polygon}, geographic);
  return geographic ? rings.holdAtAnyTurn(place) : rings.locate(place) == Location::Inside;
}

// True if the water is to the right of the ring within it.
bool isClockwise(const Ring& ring, bool geographic) {
  return signedAreaOf(geographic ? turnedRings(ring).front() : ring) < 0.0;
}

}  // namespace

SmallIslands::SmallIslands(const Coastline& coastline, const std::vector<std::size_t>& members, double least_m2,
                           const AreasWithin& areas)
    : coastline_(&coastline), areas_(&areas), area_(coastline.crs), least_m2_(least_m2) {
  SmallPieces pieces(coastline.crs.geographic);
  std::vector<std::size_t> ascending = members;
  std::ranges::sort(ascending);
  const auto forLand = [&](const auto& visit) {
    for (const std::size_t member : ascending) {
      const Feature& feature = coastline.features[member];
      if (!isLand(feature)) continue;
      for (std::size_t p = 0; p < feature.polygons.size(); ++p) visit(PolygonId{member, p}, feature.polygons[p]);
    }
  };
  forLand([&](const PolygonId& id, const Polygon& polygon) {
    if (polygon.outer.empty() || polygon.isOuterCut()) return;
    const double area = area_.of(polygon.outer);
    if (area < least_m2 && !holdsWaterPlace({polygon.outer, {}}, id.first)) pieces.add(id, polygon.outer, area);
  });
  forLand([&](const PolygonId& id, const Polygon& polygon) {
    if (!pieces.has(id)) pieces.joinLarge(polygon.outer);
  });
  small_land_ = pieces.ofSmallIslands(least_m2);
}

std::vector<Polygon> SmallIslands::without(std::size_t member, const std::function<void(const Point&)>& drop) const {
  const Feature& feature = coastline_->features[member];
  if (isLand(feature)) return withoutLand(member, drop);
  return feature.use == FeatureUse::Area ? withoutHoles(member, drop) : feature.polygons;
}

bool SmallIslands::holdsWaterPlace(const Polygon& polygon, std::size_t member) const {
  const std::optional<Point>& place = coastline_->water_at;
  return place && coastline_->features[member].use == FeatureUse::Coast &&
         holds(polygon, *place, coastline_->crs.geographic);
}

bool SmallIslands::isSea(const Polygon& polygon, std::size_t member) const {
  const Feature& feature = coastline_->features[member];
  if (feature.use != FeatureUse::Coast || polygon.outer.empty() || polygon.holes.empty()) return false;
  if (coastline_->water_at) return holdsWaterPlace(polygon, member);
  return isClockwise(polygon.outer, coastline_->crs.geographic);
}

Polygon SmallIslands::withoutSmallHoles(const Polygon& polygon, std::size_t member,
                                        const std::function<void(const Ring&)>& drop) const {
  Polygon larger{polygon.outer, {}};
  for (std::size_t h = 0; h < polygon.holes.size(); ++h) {
    const Ring& hole = polygon.holes[h];
    if (polygon.isHoleCut(h) || !isSmall(hole) || areas_->any(*coastline_, hole, member)) {
      larger.holes.push_back(hole);
    } else {
      drop(hole);
    }
  }
  return larger;
}

std::vector<Polygon> SmallIslands::withoutLand(std::size_t member,
                                               const std::function<void(const Point&)>& drop) const {
  std::vector<Polygon> kept;
  const std::vector<Polygon>& polygons = coastline_->features[member].polygons;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    if (std::ranges::binary_search(small_land_, PolygonId{member, p})) {
      drop(polygons[p].outer.front());
    } else if (isSea(polygons[p], member)) {
      kept.push_back(withoutSmallHoles(polygons[p], member, [&](const Ring& hole) { drop(hole.front()); }));
    } else {
      kept.push_back(polygons[p]);
    }
  }
  return kept;
}

std::vector<Polygon> SmallIslands::withoutHoles(std::size_t member,
                                                const std::function<void(const Point&)>& drop) const {
  std::vector<Polygon> kept;
  TakenOut taken_out(coastline_->crs.geographic);
  bool any = false;
  for (const Polygon& polygon : coastline_->features[member].polygons) {
    kept.push_back(withoutSmallHoles(polygon, member, [&](const Ring& hole) {
      drop(hole.front());
      taken_out.add(hole);
      any = true;
    }));
  }
  if (!any || kept.size() == 1) return kept;
  taken_out.build();
  std::erase_if(kept, [&](const Polygon& polygon) { return isSmall(polygon.outer) && taken_out.hold(polygon.outer); });
  return kept;
}

}  // namespace coastmesh
