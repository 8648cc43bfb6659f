#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// Places between fixed ones, whose values are to be the weighted means of their neighbours': a membrane.
struct Membrane {
  std::vector<std::size_t> begin{0};     // the first neighbour of each place, and the end
  std::vector<std::uint32_t> neighbour;  // places, by number
  std::vector<double> weight;            // of each neighbour, above 0, the same both ways
  std::vector<double> fixed;             // of each place: the sum of weights times values of its fixed neighbours
  std::vector<double> degree;            // of each place: the sum of all weights, fixed neighbours' too
  double low = std::numeric_limits<double>::infinity(), high = -low;  // of all fixed values
};

// By conjugate gradients from `values`, a first guess. It takes some steps for each place across a gap. REQUIRES:
// from each place neighbours lead to a fixed one. The same for any number of threads.
void settle(const Membrane& membrane, std::vector<double>& values, const ItemLoop& loop);

}  // namespace coastmesh
