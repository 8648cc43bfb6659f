#pragma once

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "gis/clean/clean.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Requirements on the edges of a mesh, beyond sizes.
struct EdgeWishes {
  double least_m = 0.0;         // the least length of an edge, metres on the ground
  bool no_square_ends = false;  // for triangles without obtuse angles, which need short edges in square ends of water
};

// Lengthens segments of shores shorter than wanted, and widens narrower water, in a domain that follows sizes, by
// removing vertices or moving them by at most half the size there (`mendShores`). Opens and closes nothing. Changes go
// to the report. `size` and `loop` as in `followSizes`.
Domain lengthenShores(Domain&& domain, const EdgeWishes& wishes, const SizeFunction& size, const Coastline& coastline,
                      CleanReport& report, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
