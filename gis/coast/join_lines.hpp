#pragma once

#include <cstddef>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Chains of lines that were joined end to end.
struct JoinedLines {
  struct Part {
    std::vector<Point> points;  // a ring's first point is not repeated
    std::size_t origin = 0;     // the first of the lines in it
  };
  std::vector<Part> rings;  // no ring meets itself at an end of a line
  std::vector<Part> open;
};

// Joins lines whose ends agree bit for bit, in either direction; each part has the direction of most of its edges.
// Where more than two ends meet, dead ends (such as a wharf) stay open; of the rest the outermost rings are closed
// first, then those inside them (such as an island that touches the shore), until only lines from shore to shore (such
// as a dam) are left, which stay open. Lines of less than two distinct points are dropped. Parts are in the order of
// their origins. O(n log n), except for networks of lines, where each level of nested rings takes a pass over the
// network.
JoinedLines joinLines(const std::vector<std::vector<Point>>& lines);

}  // namespace coastmesh
