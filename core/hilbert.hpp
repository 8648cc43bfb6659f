#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// The position along Hilbert's curve of a cell in a 65,536 by 65,536 grid: cells with close positions are close to each
// other.
std::uint32_t hilbertIndex(std::uint32_t x, std::uint32_t y);

// One index for each point, on a grid that covers all of them.
std::vector<std::uint32_t> hilbertIndices(std::span<const Point> points, const ItemLoop& loop = inOrder);

// The numbers of the points in their order along the curve; within a cell the smaller number first.
BulkList<std::uint32_t> hilbertOrder(std::span<const Point> points, const ItemLoop& loop = inOrder);
// The same; on a sphere along a curve on its equal-area map, since most of the sphere is a small part of the plane
// around the origin.
BulkList<std::uint32_t> hilbertOrder(std::span<const Point> points, const Surface& surface,
                                     const ItemLoop& loop = inOrder);

}  // namespace coastmesh
