#pragma once

#include <functional>

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Called before a point, or the end of a line, in the water replaces a vertex of the shore in its chain.
using ShoreMeet = std::function<void(VertexId on_shore, VertexId in_water)>;

// Leads shores through points and ends of lines in the water that are within a quarter of the size: the water between
// would need edges as short, or the shore would have to recede by more. Does nothing if something else is between, or
// if the line would leave the shore at a small angle. Straight shores change only within an element on either side.
void meetPoints(ShoreChains& chains, const ShoreMeet& met);

}  // namespace coastmesh
