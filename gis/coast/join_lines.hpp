#pragma once

#include <cstddef>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Chains made of lines that were joined end to end.
struct JoinedLines {
  struct Part {
    std::vector<Point> points;  // a ring's first point is not repeated
    std::size_t origin = 0;     // the first of the lines in it
  };
  std::vector<Part> rings;  // no ring meets itself at a line's end
  std::vector<Part> open;
};

// Joins lines whose ends agree bit for bit, either way round; each part runs as most of its lines do. Where more than
// two ends meet, what ends blindly (a wharf) stays open; of the rest the outermost rings are closed first, then those
// inside them (an island that touches the shore), until only lines from shore to shore (a dam) are left over, which
// stay open. Lines of less than two distinct points are left out. Parts come in the order of their origins. Cost O(n
// log n) but for nets of lines, where each ring around others costs a pass over its net.
JoinedLines joinLines(const std::vector<std::vector<Point>>& lines);

}  // namespace coastmesh
