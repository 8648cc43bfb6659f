#pragma once

#include <vector>

#include "core/pslg.hpp"
#include "core/triangulate/label_regions.hpp"

namespace coastmesh {

// A domain's graph while its coast is being fitted to sizes.
struct ShoreGraph {
  Pslg pslg;                     // labelled
  std::vector<VertexId> source;  // of each point: index of the domain's point, or kNone
};

inline RegionId waterOf(const Segment& s) { return s.left >= 0 ? s.left : s.right; }

}  // namespace coastmesh
