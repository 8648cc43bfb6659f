#pragma once

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "gis/clean/clean.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

// What the edges of a mesh are to be like, beyond what sizes say.
struct EdgeWishes {
  double least_m = 0.0;         // metres on the ground: no edge is to be shorter
  bool no_square_ends = false;  // for triangles without obtuse angles: these take short edges in square ends of water
};

// Lengthens segments of the shores of a domain that follows sizes where they are shorter, and widens water that is
// narrower: vertices are moved by at most half the size there, or go (`mendShores`). Nothing is opened or closed.
// Changes go to the report. `size` and `loop` as in `followSizes`.
Domain lengthenShores(Domain&& domain, const EdgeWishes& wishes, const SizeFunction& size, const Coastline& coastline,
                      CleanReport& report, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
