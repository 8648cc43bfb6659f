#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// How a chain of longitudes and latitudes goes on past the antimeridian.
struct Turns {
  std::vector<int> of;  // by point: turns of 360 degrees to be added, so that no edge jumps; 0 for the first
  int round = 0;        // of a ring: turns at its end; not 0 where it goes round a pole
  bool any = false;     // whether an edge jumps at all
};

// An edge of more than 180 degrees jumps from one end of the map to the other. One of exactly 360 does so where others
// jump too, since both of its ends then lie on one meridian, but not where it alone would keep the ring from closing;
// where no other does, the ring is one of the map, and such an edge goes along all of it. An edge from a pole to the
// same pole has no length, whatever its longitudes.
Turns turnsOf(const std::vector<Point>& lonlat, bool closed);

// Whether an edge goes from one end of the map to the other: the ring crosses the antimeridian, or goes round a pole.
bool longitudesJump(const Ring& lonlat);

// The pole that a ring which goes round one holds: the nearer, -90 or 90.
double poleWithin(const Ring& lonlat);

// A ring in longitudes and latitudes as rings of the plate carrée that hold the same places. One whose longitudes jump
// across the antimeridian goes on past it, and is there in three turns; one that goes round a pole is closed by way of
// the pole that is nearer. Any other is given as it is.
std::vector<Ring> turnedRings(const Ring& lonlat);

}  // namespace coastmesh
