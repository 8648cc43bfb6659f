#include "gis/coast/input_polygons.hpp"

#include <algorithm>
#include <utility>

#include "gis/coast/turned_rings.hpp"

namespace coastmesh {

InputPolygons::InputPolygons(const std::vector<Polygon>& polygons, bool may_jump) {
  const auto add = [&](const Ring& ring) {
    if (!may_jump) return rings_.add(ring);
    for (const Ring& turned : turnedRings(ring)) rings_.add(turned);
  };
  for (const Polygon& polygon : polygons) {
    add(polygon.outer);
    std::ranges::for_each(polygon.holes, add);
  }
  rings_.build();
}

Location InputPolygons::locate(const Point& place) const {
  return rings_.edgeCount() == 0 ? Location::Outside : rings_.locate(place);
}

bool InputPolygons::holdAtAnyTurn(const Point& place) const {
  for (const double turn : {-360.0, 0.0, 360.0}) {
    if (locate({place.x + turn, place.y}) == Location::Inside) return true;
  }
  return false;
}

PolygonsByPlace::PolygonsByPlace(std::vector<InputPolygons> polygons, bool geographic)
    : polygons_(std::move(polygons)), geographic_(geographic) {
  std::vector<Box> boxes;
  for (const InputPolygons& polygon : polygons_) boxes.push_back(polygon.bounds());
  tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

}  // namespace coastmesh
