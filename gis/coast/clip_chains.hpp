#pragma once

#include <limits>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A box, and the turn in which longitudes are to be seen before they are compared with it: `shift` is added.
struct ClipBox {
  Box box;
  double shift = 0;
  // The longest straight pieces of what runs along its sides, in x along those of the south and north, in y along the
  // others. Pieces end at multiples, so that those of all chains fit together. Infinite: as long as they come.
  double piece_x = std::numeric_limits<double>::infinity();
  double piece_y = std::numeric_limits<double>::infinity();
};

// The part of a ring's inside that lies in the box, even-odd; its edges may run along the box's sides more than once.
// Points of the ring keep their bits. After Sutherland & Hodgman, "Reentrant polygon clipping" (1974).
Ring clipRing(const Ring& ring, const ClipBox& clip);

// The parts of a line that lie in the box.
std::vector<std::vector<Point>> clipLine(const std::vector<Point>& line, const ClipBox& clip);

// The same for chains whose longitudes jump (`turnsOf`): the parts in the box seen from any turn, a ring round a pole
// with all that it holds. Where the box holds that pole, such a ring is given whole: what it is cut along would not lie
// beyond the box. New points have longitudes from `west` on, less than 360 further. REQUIRES: no shift; sides in x 360
// degrees apart at most, or infinite.
std::vector<Ring> clipTurnedRing(const Ring& lonlat, const ClipBox& clip, double west);
std::vector<std::vector<Point>> clipTurnedLine(const std::vector<Point>& lonlat, const ClipBox& clip, double west);

}  // namespace coastmesh
