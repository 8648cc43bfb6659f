#pragma once

#include <functional>

#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

// Called before a vertex of the shore gives its place in the chain to a point or the end of a line in the water.
using ShoreMeet = std::function<void(VertexId on_shore, VertexId in_water)>;

// Lets shores pass through points, and through ends of lines, that lie in the water within a quarter of the size of
// them: the water between would need edges as short, or the shore would have to recede by more. Not where something
// else lies between, nor where the line would leave the shore at a small angle. Straight shores stay as they are except
// for an element to either side.
void meetPoints(ShoreChains& chains, const ShoreMeet& met);

}  // namespace coastmesh
