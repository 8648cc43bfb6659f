#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// An edge of a mesh where it ends.
enum class EndKind : std::uint8_t { Shore, OpenOfOne, OpenOfOther };

// Triangles that fill the holes in a mesh of two which only open boundaries of both surround: there the meshes adjoin
// without sharing nodes. `kindOf` is asked for edges without a triangle across. Counter-clockwise.
std::vector<std::array<VertexId, 3>> fillEnclosed(const TriMesh& mesh, const std::function<EndKind(EdgeRef)>& kindOf,
                                                  const ItemLoop& loop = inOrder);

}  // namespace coastmesh
