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

// The domain's graph without the parts of its boundary that `assignBoundaries` will open by files or depths, and that
// are therefore no shore for sizes; nullopt if it opens nothing. Rivers stay: their mouths are as fine as the shore.
// Segments are divided where openings begin or end, to within `least_m`, the longest less finely. The decision is that
// of the same function (`defineKinds`): pieces stand for the elements that segments will be divided into, depths are
// bilinear at their ends, and nothing is opened without a depth. A boundary shorter than `least_length_m` is not
// opened. Throws InputError, BadPslg, Cancelled.
std::optional<Pslg> shoreForSizes(const Domain& domain, const Crs& crs, const BoundaryOptions& boundaries,
                                  const DepthOptions& depths, const ElementLengths& lengths,
                                  const RunControl& control = {}, const ItemLoop& loop = inOrder);

// The domain with these parts of its boundary tagged as open (`kOpenedTag`), for a coast that follows sizes: it keeps
// the water at openings, and openings are as coarse as the water beside them.
Domain withOpenings(Domain&& domain, const Crs& crs, const BoundaryOptions& boundaries, const DepthOptions& depths,
                    const ElementLengths& lengths, const RunControl& control = {}, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
