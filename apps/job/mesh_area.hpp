#pragma once

#include <numeric>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The sum of the areas of a grid's triangles; the same for any number of threads.
inline double meshArea(const Grid& grid, const ItemLoop& loop) {
  const std::vector<double> sums = overStretches(loop, grid.area_m2.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t t = first; t < last; ++t) sum += grid.area_m2[t];
    return sum;
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace coastmesh
