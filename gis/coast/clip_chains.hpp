#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A box, and the turn in which longitudes are to be seen before they are compared with it: `shift` is added.
struct ClipBox {
  Box box;
  double shift = 0;
};

// The part of a ring's inside that lies in the box, even-odd; its edges may run along the box's sides more than once.
// Points of the ring keep their bits. After Sutherland & Hodgman, "Reentrant polygon clipping" (1974).
Ring clipRing(const Ring& ring, const ClipBox& clip);

// The parts of a line that lie in the box.
std::vector<std::vector<Point>> clipLine(const std::vector<Point>& line, const ClipBox& clip);

}  // namespace coastmesh
