#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/point.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// The place of a cell of a 65,536 by 65,536 grid along Hilbert's curve: cells with near indices lie near to one
// another.
std::uint32_t hilbertIndex(std::uint32_t x, std::uint32_t y);

// One index a point, on a grid that covers all of them.
std::vector<std::uint32_t> hilbertIndices(std::span<const Point> points);

// The numbers of the points in their order along the curve; of one cell the lesser first.
std::vector<std::uint32_t> hilbertOrder(std::span<const Point> points);
// The same; on a sphere along a curve that is drawn on its equivalent map, since the plane has most of it in a small
// part round the origin.
std::vector<std::uint32_t> hilbertOrder(std::span<const Point> points, const Surface& surface);

}  // namespace coastmesh
