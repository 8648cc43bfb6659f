#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// A membrane: places between fixed ones, each of which gets the weighted mean of its neighbours' values.
struct Membrane {
  std::vector<std::size_t> begin{0};     // the first neighbour of each place, and the end
  std::vector<std::uint32_t> neighbour;  // places, by number
  std::vector<double> weight;            // of each neighbour, above 0, the same both ways
  std::vector<double> fixed;             // of each place: the sum of weights times values of its fixed neighbours
  std::vector<double> degree;            // of each place: the sum of all weights, fixed neighbours included
  double low = std::numeric_limits<double>::infinity(), high = -low;  // of all fixed values
};

// Solves for `values` by conjugate gradients, starting from the given ones: some steps for each place across a gap, at
// most 1000. REQUIRES: each place is connected to a fixed one. The result is the same for any number of threads.
void settle(const Membrane& membrane, std::vector<double>& values, const ItemLoop& loop);

}  // namespace coastmesh
