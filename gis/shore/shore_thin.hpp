#pragma once

#include <functional>

#include "core/item_loop.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

inline constexpr double kMuchMore = 1.5;  // than what shores were thinned for before: they are thinned again

struct ShoreThinning {
  const BoxTree& lines;             // of boxes: shores stay there
  bool keeps_narrow_water = false;  // else water narrower than an element will be closed
  // A vertex of an island that is dropped, before it is, and its area in the plane.
  std::function<void(VertexId, double)> dropped;
  // What shores were thinned for before, if they were: they are thinned again only where more is wanted (`kMuchMore`).
  const SizeFunction* before = nullptr;
};

// Takes out of shores what is much finer than the sizes wanted, so that all that follows costs by the elements and not
// by the data. Islands smaller than a triangle of that size go. Runs of vertices become single segments, no longer than
// six tenths of the size and no further off than a tenth of it, nor than a fifth of the distance to the shore on the
// other side of the land, and of the water where narrow water is kept: these come no nearer than six tenths of what
// they were, and no nearer by more than a fifth of the size. Between a run and its segment lies nothing else, so that
// nothing crosses or changes sides. Open boundaries stay.
// `loop` lends threads.
void thinShores(ShoreChains& chains, const ShoreThinning& thinning, const ShoreLoss& gone,
                const ItemLoop& loop = inOrder);

}  // namespace coastmesh
