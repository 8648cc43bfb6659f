#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/size/size_cells.hpp"
#include "core/size/size_grading.hpp"
#include "core/size/size_places.hpp"
#include "core/size/size_tree_task.hpp"

namespace coastmesh {

// The vertices that every cell has, numbered as in `LeafVertices`: corners and centre.
inline constexpr std::array<unsigned, 5> kOwnVertices = {0, 2, 4, 6, 8};
// The middle of each side, a vertex only of some cells.
inline constexpr std::array<unsigned, SizeCells::kSides> kMiddles = {3, 5, 1, 7};
// The numbers of a cell's own vertices; kNone where there is none yet.
using OwnVertices = std::array<std::uint32_t, kOwnVertices.size()>;
inline constexpr OwnVertices kNoVertices = {kNone, kNone, kNone, kNone, kNone};

// The vertices of a size tree's cells, and their sizes.
struct SizeVertices {
  SizePlaces places;        // some are of cells that were split
  GradedSizes sizes;        // until sizes are graded, `own` alone has entries
  std::size_t sampled = 0;  // the vertices whose sizes `sampleNew` has found
};

// In `own`: the size is not known yet.
inline constexpr double kUnasked = -1.0;

// Samples sizes at new vertices, except those that are known already.
void sampleNew(SizeVertices& vertices, const SizeCells& cells, const SizeTreeTask& task);

}  // namespace coastmesh
