#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <utility>
#include <vector>

#include "gis/crs/geodesy.hpp"
#include "gis/elements/quads.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/linked_grid.hpp"

namespace coastmesh::testing {

// Rectangles twice as long as high, of which those with `isQuad(column, row)` are quadrilaterals that start at a random
// node, the others two triangles; elements are in random order. A row has columns + 1 nodes. Lengths in units of the
// CRS.
inline Grid mixedGrid(int columns, int rows, const std::function<bool(int, int)>& isQuad, const Crs& crs = {},
                      double height = 1.0) {
  Grid grid;
  grid.crs = crs;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) grid.nodes.push_back({2.0 * height * i, height * j});
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  std::mt19937 random(20240504);
  std::vector<std::vector<std::uint32_t>> elements;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      std::array<std::uint32_t, 4> q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      if (isQuad(i, j)) {
        std::ranges::rotate(q, q.begin() + static_cast<std::ptrdiff_t>(random() % 4));
        elements.push_back({q.begin(), q.end()});
      } else {
        elements.push_back({q[0], q[1], q[2]});
        elements.push_back({q[0], q[2], q[3]});
      }
    }
  std::ranges::shuffle(elements, random);
  for (const auto& nodes : elements) addElement(grid, nodes);
  grid.boundaries = findBoundaries(linkGrid(grid).mesh);
  return grid;
}

// The nodes of all elements, in their order.
inline std::vector<std::vector<std::uint32_t>> elementsOf(const Grid& grid) {
  std::vector<std::vector<std::uint32_t>> all;
  const std::vector<Quad> quads = quadsOf(grid);
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    const auto isFirst = [t](const Quad& quad) { return quad.halves[0] == t; };
    const auto isSecond = [t](const Quad& quad) { return quad.halves[1] == t; };
    if (const auto quad = std::ranges::find_if(quads, isFirst); quad != quads.end())
      all.emplace_back(quad->nodes.begin(), quad->nodes.end());
    else if (std::ranges::none_of(quads, isSecond))
      all.emplace_back(grid.triangles[t].begin(), grid.triangles[t].end());
  }
  return all;
}

}  // namespace coastmesh::testing
