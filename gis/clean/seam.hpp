#pragma once

#include <optional>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/coast/cut_meridians.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// Meridians along which the data are cut: edges along them lie on both sides of a cut.
struct Seam {
  CutMeridians cuts;

  bool holds(const Point& p) const { return cuts.at(p.x).has_value(); }
};

// If rings have edges along meridians a full turn apart (as data, or a frame, that are cut at the antimeridian) and
// `projection` brings these together, edges along either of the two also get the points of the other, so that the two
// sides of the cut agree. Rings that do not end at the cut may lie in another turn. Points are only added.
std::optional<Seam> healSeam(const std::vector<Ring*>& rings, const Crs& crs, const Projection& projection);

}  // namespace coastmesh
