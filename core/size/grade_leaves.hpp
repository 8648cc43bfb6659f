#pragma once

#include "core/size/size_cells.hpp"
#include "core/size/size_leaves.hpp"
#include "core/size/size_tree_task.hpp"
#include "core/size/size_vertices.hpp"

namespace coastmesh {

// Limits how fast sizes grow, and splits leaves that are too large for the sizes that grow into them. False if that
// required too many cells.
bool gradeLeaves(SizeCells& cells, SizeVertices& vertices, SizeLeaves& leaves, const SizeTreeTask& task);

}  // namespace coastmesh
