#pragma once

#include <limits>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A box, and the offset `shift` that is added to longitudes before comparing them with it.
struct ClipBox {
  Box box;
  double shift = 0;
  // Length of the pieces into which sides are divided: in x along south and north, in y along west and east. Pieces end
  // at multiples of it, so that those of all chains match. Infinite: not divided.
  double piece_x = std::numeric_limits<double>::infinity();
  double piece_y = std::numeric_limits<double>::infinity();
};

// The part of a ring's inside that is in the box, even-odd; its edges may run along the box's sides more than once.
// Points of the ring keep their bits. After Sutherland & Hodgman, "Reentrant polygon clipping" (1974).
Ring clipRing(const Ring& ring, const ClipBox& clip);

// The parts of a line that lie in the box.
std::vector<std::vector<Point>> clipLine(const std::vector<Point>& line, const ClipBox& clip);

// The same for chains whose longitudes jump (`turnsOf`): the parts in the box for any full turns added to longitudes. A
// ring around a pole includes the area up to that pole; if the box reaches the pole, it is returned whole, since the
// cut to the pole would be inside the box. New points have longitudes from `west` to less than 360 above it. REQUIRES:
// no shift; sides in x at most 360 degrees apart, or infinite.
std::vector<Ring> clipTurnedRing(const Ring& lonlat, const ClipBox& clip, double west);
std::vector<std::vector<Point>> clipTurnedLine(const std::vector<Point>& lonlat, const ClipBox& clip, double west);

}  // namespace coastmesh
