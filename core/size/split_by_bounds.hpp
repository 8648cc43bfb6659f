#pragma once

#include <optional>
#include <vector>

#include "core/size/size_cells.hpp"
#include "core/size/size_tree_task.hpp"
#include "core/size/size_vertices.hpp"

namespace coastmesh {

// What splitting leaves besides the cells.
struct SplitByBounds {
  std::vector<OwnVertices> own_vertices;  // of the first cells
  std::optional<SizeDemand> excess;       // if it has given up: an estimate of the demand
};

// Splits cells level by level, so that many places are evaluated at once, until they are small enough for the source's
// bounds in them and its sizes at their vertices. Gives up if these require too many vertices or cells.
SplitByBounds splitByBounds(SizeCells& cells, SizeVertices& vertices, const SizeTreeTask& task);

}  // namespace coastmesh
