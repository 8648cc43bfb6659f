#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"
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

}  // namespace coastmesh
