#include "gis/projection/area_outline.hpp"

#include <numeric>
#include <utility>

#include "core/metric.hpp"
#include "gis/coast/turned_rings.hpp"

namespace coastmesh {

namespace {

// True if what is on the left of the ring is also what it encloses on the map: around a pole, the closer pole.
bool enclosesItsLeft(const Crs& crs, const Ring& ring) {
  const Turns turns = crs.geographic ? turnsOf(ring, true) : Turns{std::vector<int>(ring.size(), 0)};
  if (turns.round != 0) return (turns.round > 0) == (poleWithin(ring) > 0.0);  // north is to the left of the way east
  const auto at = [&](std::size_t i) { return Point{ring[i].x + 360.0 * turns.of[i], ring[i].y}; };
  double twice_area = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point from = at(i) - at(0), to = at((i + 1) % ring.size()) - at(0);
    twice_area += cross(from, to);
  }
  return twice_area > 0.0;
}

}  // namespace

Coastline areaWithin(const Crs& crs, std::vector<Ring> rings, std::vector<Point> within, const std::string& source) {
  Feature area, land;
  area.source = land.source = source;
  land.use = FeatureUse::Land;
  for (Ring& ring : rings) {
    Feature& feature = enclosesItsLeft(crs, ring) ? area : land;
    feature.polygons.emplace_back().outer = std::move(ring);
  }
  Coastline outline;
  outline.crs = crs;
  area.lines.push_back(std::move(within));
  outline.features.push_back(std::move(area));
  if (!land.polygons.empty()) outline.features.push_back(std::move(land));
  return outline;
}

Projection fittedWithin(const Crs& crs, std::vector<Ring> rings, std::vector<Point> within, const std::string& source,
                        SurfaceKind kind) {
  const Coastline outline = areaWithin(crs, std::move(rings), std::move(within), source);
  std::vector<std::size_t> all(outline.features.size());
  std::iota(all.begin(), all.end(), 0);
  return Projection::fitted(outline, all, kind);
}

}  // namespace coastmesh
