#pragma once

#include <cmath>
#include <cstdint>

#include "core/metric.hpp"
#include "gis/crs/crs.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"

namespace coastmesh::testing {

// A sea of `cells` by `cells` parallelograms with sides of 1000 m, each cut from north-west to south-east: the
// south-western and north-eastern corners are one triangle. `kind_of` decides on boundary edges.
inline Grid slantingSea(std::uint32_t cells, double corner_deg, const BoundaryKindOf& kind_of) {
  const std::uint32_t row = cells + 1;
  const double corner = toRadians(corner_deg);
  Grid grid;
  for (std::uint32_t j = 0; j < row; ++j)
    for (std::uint32_t i = 0; i < row; ++i)
      grid.nodes.push_back({1000.0 * (i + j * std::cos(corner)), 1000.0 * j * std::sin(corner)});
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t sw = j * row + i, se = sw + 1, nw = sw + row, ne = nw + 1;
      grid.triangles.push_back({sw, se, nw});
      grid.triangles.push_back({se, ne, nw});
    }
  }
  grid.z.assign(grid.nodes.size(), -20.0);
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), kind_of);
  return grid;
}

// A grid in metres, scaled to degrees at the equator.
inline Grid inDegrees(Grid grid) {
  grid.crs = wgs84();
  for (Point& p : grid.nodes) p = {p.x / 111319.5, p.y / 110574.3};
  return grid;
}

}  // namespace coastmesh::testing
