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
  std::int64_t balance = 0;  // edges of lines in the arc's direction, minus edges against it
};

// Arcs that form a ring, each with its direction.
struct ArcUse {
  std::uint32_t arc = 0;
  bool reversed = false;
};

struct PeeledNetwork {
  std::vector<std::vector<ArcUse>> rings;
  std::vector<std::uint32_t> open;  // arcs in no ring
};

// Divides a planar network of arcs into rings from the outside inwards, see `joinLines`. Returns every arc once.
// REQUIRES: nodes below `node_count`.
PeeledNetwork peelNetwork(const std::vector<Arc>& arcs, std::uint32_t node_count);

}  // namespace coastmesh
