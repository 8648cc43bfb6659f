#pragma once

#include <vector>

#include "core/pslg.hpp"
#include "gis/clean_nodes.hpp"

namespace coastmesh {

// Labels the faces between noded edges: a face belongs to the first feature that holds it by the even-odd rule. Returns
// the edges that part two labels and the open lines inside the domain, from the lower to the higher vertex, sorted.
// What is dropped goes to the report.
std::vector<Segment> labelFaces(const CleanChains& chains, const NodedEdges& edges, const Coastline& coastline,
                                CleanReport& report);

}  // namespace coastmesh
