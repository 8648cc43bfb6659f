#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Flags of the triangles in `taken` and of those that have a node in common with them: how far a part may grow.
std::vector<std::uint8_t> reachOf(const TriMesh& mesh, const std::vector<std::uint8_t>& taken,
                                  const ItemLoop& loop = inOrder);

// Sets the flags in `taken` of triangles that no neighbour that stays would be left beside, and of which a neighbour is
// taken, if `reach` has them too. Returns their number.
std::size_t takeInSingle(const TriMesh& mesh, const std::vector<std::uint8_t>& reach, std::vector<std::uint8_t>& taken,
                         const ItemLoop& loop = inOrder);

// The same for triangles with a node that has a flag in `at_nodes`.
std::size_t takeInAt(const TriMesh& mesh, const std::vector<std::uint8_t>& at_nodes,
                     const std::vector<std::uint8_t>& reach, std::vector<std::uint8_t>& taken,
                     const ItemLoop& loop = inOrder);

}  // namespace coastmesh
