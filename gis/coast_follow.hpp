#pragma once

#include "core/size_function.hpp"
#include "gis/clean.hpp"
#include "gis/coastline.hpp"

namespace coastmesh {

// Makes the shore as coarse as the elements beside it: no shore is moved by more than a quarter of the size wanted
// there, and islands smaller than a triangle of that size go; nothing crosses, and no island changes sides: see
// `simplifyEdges`. Open water's rim keeps its corners and is moved by a hundredth of the size; lines inside the water
// stay as they are. What was dropped goes to the report as simplified points and small islands. Where all of the domain
// is smaller than its elements, its last three points stay. A graph without labels is labelled first, by its holes.
// Throws BadPslg where that cannot be.
Domain followSizes(Domain&& domain, const SizeFunction& size, const Coastline& coastline, CleanReport& report);

}  // namespace coastmesh
