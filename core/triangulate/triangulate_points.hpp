#pragma once

#include <span>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/surface.hpp"
#include "core/triangulate/triangulation.hpp"

namespace coastmesh {

// The Delaunay triangulation of points. Many points are divided by lines into parts, which are triangulated at the same
// time and merged in pairs (Dwyer, "A faster divide-and-conquer algorithm for constructing Delaunay triangulations",
// 1987; we differ: large parts are triangulated point by point). The parts depend on the points alone. Throws Clash if
// two points coincide. O(n log n) time.
Triangulation triangulatePoints(std::span<const Point> points, const Surface& surface = {},
                                const ItemLoop& loop = inOrder);

}  // namespace coastmesh
