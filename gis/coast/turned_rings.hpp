#pragma once

#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Whether an edge goes from one end of the map to the other: the ring crosses the antimeridian, or goes round a pole.
bool longitudesJump(const Ring& lonlat);

// A ring in longitudes and latitudes as rings of the plate carrée that hold the same places. One whose longitudes jump
// across the antimeridian goes on past it, and is there in three turns; one that goes round a pole is closed by way of
// the pole that is nearer. Any other is given as it is.
std::vector<Ring> turnedRings(const Ring& lonlat);

}  // namespace coastmesh
