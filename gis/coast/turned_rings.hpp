#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Turns that continue a chain of longitudes and latitudes past the antimeridian.
struct Turns {
  std::vector<int> of;  // for each point: turns of 360 degrees to add, so that no edge jumps; 0 for the first
  int round = 0;        // of a ring: turns at its end; not 0 if it goes around a pole
  bool any = false;     // true if some edge jumps
};

// An edge of more than 180 degrees jumps from one end of the map to the other. An edge of exactly 360 jumps if others
// do, since both of its ends are then on one meridian, unless it alone would keep the ring from closing. If no other
// edge jumps, it does so in rings that close and are no band round the globe: an island across the antimeridian. In
// others, such as boxes of the map, it runs along all of the map. An edge from a pole to the same pole has no length,
// whatever its longitudes.
Turns turnsOf(const std::vector<Point>& lonlat, bool closed);

// True if some edge jumps from one end of the map to the other: the ring crosses the antimeridian or surrounds a pole.
bool longitudesJump(const Ring& lonlat);

// The pole inside a ring that surrounds one, -90 or 90: that of the hemisphere of its mean latitude.
double poleWithin(const Ring& lonlat);

// A ring in longitudes and latitudes as rings of the plate carrée with the same inside. A ring that jumps across the
// antimeridian is continued past it and returned at three offsets; one around a pole is closed through the closer pole.
// Other rings are returned unchanged.
std::vector<Ring> turnedRings(const Ring& lonlat);

}  // namespace coastmesh
