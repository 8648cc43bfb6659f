#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/point.hpp"

namespace coastmesh {

// The vertices of a square cell, in rows from below: corners, middles of sides, centre. The middle of a side is kNone where no other
// cell has a corner there. The cell's triangles lie between its centre and the edges of its rim.
using LeafVertices = std::array<std::uint32_t, 9>;

// Sizes grow by this share of the grade where they are graded.
inline constexpr double kSizeGrowth = 0.94;

// Lowers sizes at the vertices that are larger than another's and `grade` times the distance from it, as far as sizes on the cells'
// triangles are too steep for `grade` at all. Answers which vertex decides on each: itself where it is one that others grow from, kNone
// where nothing was too steep. Empty where nothing is anywhere. Cells meet in whole edges.
std::vector<std::uint32_t> gradeSizes(std::vector<double>& sizes, std::span<const Point> places,
                                      std::span<const LeafVertices> leaves, double grade);

}  // namespace coastmesh
