#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/size/size_cells.hpp"
#include "core/size/size_grading.hpp"
#include "core/size/size_tree_task.hpp"
#include "core/size/size_vertices.hpp"

namespace coastmesh {

// The leaves of a size tree, by their numbers.
struct SizeLeaves {
  std::vector<LeafVertices> vertices;
  std::vector<char> is_wanted;  // false where nobody will evaluate sizes

  std::size_t count() const { return vertices.size(); }
};

// Numbers leaves and their vertices so that neighbours are close in memory; samples sizes at new vertices.
// `own_vertices` holds the numbers known of the first cells.
SizeLeaves numberLeaves(SizeCells& cells, SizeVertices& vertices, std::vector<OwnVertices>&& own_vertices,
                        const SizeTreeTask& task);
// Takes in the leaves, from cell `first` on, that `splitNumbered` has made. Returns the leaves that are new or have
// other vertices.
std::vector<std::uint32_t> addNewLeaves(SizeLeaves& leaves, const SizeCells& cells, std::size_t first,
                                        SizeVertices& vertices, const SizeTreeTask& task);

}  // namespace coastmesh
