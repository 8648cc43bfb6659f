#pragma once

#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/size_function.hpp"

namespace coastmesh {

// Sizes that grow evenly with the distance from the shore and that nothing else decides on: how fast, and those on the
// shore itself, which need not be looked for.
struct EvenSizes {
  double rate;
  const SizeFunction& on_shore;
};

// Sizes at places, by all threads. `on_shore`: which of them lie there, where sizes are `even`.
std::vector<double> sizesAt(std::span<const Point> places, std::span<const char> on_shore, const SizeFunction& size,
                            const EvenSizes* even, const ItemLoop& loop);

}  // namespace coastmesh
