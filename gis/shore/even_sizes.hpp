#pragma once

#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/size_function.hpp"

namespace coastmesh {

// Sizes that depend on the distance from the shore alone: their growth with it, and those at the shore, which are known
// without a search.
struct EvenSizes {
  double rate;
  const SizeFunction& on_shore;
};

// Sizes at places, with the threads of `loop`. `on_shore`: flags of the places at the shore; read only if `even` is
// given.
std::vector<double> sizesAt(std::span<const Point> places, std::span<const char> on_shore, const SizeFunction& size,
                            const EvenSizes* even, const ItemLoop& loop);

}  // namespace coastmesh
