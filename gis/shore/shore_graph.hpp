#pragma once

#include <vector>

#include "core/pslg.hpp"

namespace coastmesh {

// A domain's graph while its coast is made to follow sizes.
struct ShoreGraph {
  Pslg pslg;                     // labelled
  std::vector<VertexId> source;  // of each point: the domain's that it is, or kNone
};

inline bool isBoundary(const Segment& s) { return (s.left >= 0) != (s.right >= 0); }
inline RegionId waterOf(const Segment& s) { return s.left >= 0 ? s.left : s.right; }

}  // namespace coastmesh
