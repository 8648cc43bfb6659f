#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

// Polygons in the coordinates of the input, where inside is even-odd over all rings. In a plane that shows most of the
// globe, rings do not say which of their sides is the inside.
class InputPolygons {
 public:
  // If `may_jump`, coordinates are degrees, and rings whose longitudes jump are continued past the antimeridian.
  InputPolygons(const std::vector<Polygon>& polygons, bool may_jump);

  Box bounds() const { return rings_.bounds(); }
  Location locate(const Point& place) const;
  // True if the place, or one a turn of longitudes from it, lies inside.
  bool holdAtAnyTurn(const Point& place) const;

 private:
  ChainIndex rings_{ChainIndex::Kind::Rings};
};

// Many of them, searchable by place.
class PolygonsByPlace {
 public:
  // If `geographic`, places are found at any turn of longitudes.
  PolygonsByPlace(std::vector<InputPolygons> polygons, bool geographic);

  // Calls `found(polygon)` for those that hold the place, or one a turn of longitudes from it; maybe more than once.
  template <typename Found>
  void visit(const Point& place, Found&& found) const {
    if (polygons_.empty() || !std::isfinite(place.x) || !std::isfinite(place.y)) return;
    for (const double turn : {0.0, -360.0, 360.0}) {
      if (turn != 0.0 && !geographic_) break;
      const Point turned{place.x + turn, place.y};
      tree_.visit(Box::of(turned, turned), [&](std::uint32_t p) {
        if (polygons_[p].locate(turned) != Location::Outside) found(p);
      });
    }
  }

 private:
  std::vector<InputPolygons> polygons_;
  bool geographic_;
  BoxTree tree_;
};

}  // namespace coastmesh
