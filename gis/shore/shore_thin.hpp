#pragma once

#include <functional>

#include "core/item_loop.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {

inline constexpr double kMuchMore = 1.5;  // sizes larger than in an earlier thinning by this are worth another

struct ShoreThinning {
  const BoxTree& lines;             // of boxes in which shores stay
  bool keeps_narrow_water = false;  // else water narrower than an element is closed later
  // Called before an island is dropped, with one of its vertices and its area in the plane.
  std::function<void(VertexId, double)> dropped;
  // Sizes of an earlier thinning, or null: shores are thinned again only where sizes are at least `kMuchMore` times
  // these.
  const SizeFunction* before = nullptr;
};

// Removes detail much finer than the sizes wanted, so that the cost of later steps depends on the elements and not on
// the data. Drops islands smaller than a triangle of that size. Runs of vertices become single segments, at most six
// tenths of the size long, and off by at most a tenth of it and a fifth of the distance to the shore on the other side
// of the land (and of the water if narrow water is kept). So the distance between two shores remains at least six
// tenths of what it was, and shrinks by at most a fifth of the size. Nothing else lies between a run and its segment,
// so nothing crosses or changes sides. Open boundaries stay. `loop` provides threads.
void thinShores(ShoreChains& chains, const ShoreThinning& thinning, const ShoreLoss& gone,
                const ItemLoop& loop = inOrder);

}  // namespace coastmesh
