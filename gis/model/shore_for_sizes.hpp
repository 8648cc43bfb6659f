#pragma once

#include <optional>

#include "core/run_control.hpp"
#include "gis/clean/domain.hpp"
#include "gis/model/boundary_edges.hpp"
#include "gis/model/depth.hpp"

namespace coastmesh {

// The lengths of elements on the boundary, metres; infinite where unknown.
struct ElementLengths {
  double least_m = std::numeric_limits<double>::infinity();
  double most_m = std::numeric_limits<double>::infinity();
};

// The domain's graph without those parts of its boundary that `assignBoundaries` is going to open by files or depths,
// and that are no shore for sizes therefore; none if it opens nothing. Rivers stay: their mouths are as fine as the
// shore. Segments are cut where that changes, to `least_m` but for the longest. It is decided by the same function:
// long segments stand for the elements that they are going to be cut into, depths are bilinear at their ends, and where
// no raster has one nothing is opened. A boundary shorter than `least_length_m` is not opened. Throws InputError,
// BadPslg, Cancelled.
std::optional<Pslg> shoreForSizes(const Domain& domain, const Crs& crs, const BoundaryOptions& boundaries,
                                  const DepthOptions& depths, const ElementLengths& lengths,
                                  const RunControl& control = {}, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
