#pragma once

#include <optional>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// Two meridians 360 degrees apart.
struct Seam {
  double west, east;

  bool holds(const Point& p) const { return p.x == west || p.x == east; }
};

// If the rings' longitudes span exactly 360 degrees (as in data cut at the antimeridian) and `projection` brings the
// first and the last meridian together, edges along either of the two also get the points of the other, so that the two
// sides of the cut agree. Points are only added.
std::optional<Seam> healSeam(const std::vector<Ring*>& rings, const Crs& crs, const Projection& projection);

}  // namespace coastmesh
