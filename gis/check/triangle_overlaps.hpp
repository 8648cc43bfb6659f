#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

struct TriangleOverlap {
  std::uint32_t triangle = 0, other = 0;
};

// Triangles that overlap others by more than rounding, each once with one of those, ascending: sheets on top of each
// other, strips wound over themselves, copies. `mesh` is the grid's, from `linkTriangles`. In degrees sides are great
// circles, so ±180 and poles do not matter. Triangles that are not counter-clockwise are ignored.
//
// If no triangle is inverted, as many lie on one side of an edge as on the other, unless the edge has no neighbour. An
// area that is covered twice therefore ends at such edges, and one of their triangles is part of it. So each triangle
// is tested only against these: O(n log n).
std::vector<TriangleOverlap> triangleOverlaps(const Grid& grid, const TriMesh& mesh, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
