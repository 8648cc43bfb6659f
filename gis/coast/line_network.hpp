#pragma once

#include <cstdint>
#include <vector>

#include "core/point.hpp"

namespace coastmesh {

// A chain between two junctions of lines.
struct Arc {
  std::uint32_t from = 0, to = 0;  // nodes
  std::vector<Point> points;       // both ends included
  std::size_t origin = 0;
  std::int64_t balance = 0;  // points of lines that run as the arc does, less those of lines that run against it
};

// Arcs that form a ring, each with the way in which it is gone through.
struct ArcUse {
  std::uint32_t arc = 0;
  bool reversed = false;
};

struct PeeledNetwork {
  std::vector<std::vector<ArcUse>> rings;
  std::vector<std::uint32_t> open;  // arcs in no ring
};

// Takes a planar net of arcs apart into rings from the outside inwards, see `joinLines`. REQUIRES: nodes below
// `node_count`. Every arc comes out once.
PeeledNetwork peelNetwork(const std::vector<Arc>& arcs, std::uint32_t node_count);

}  // namespace coastmesh
