#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Clears the flags in `taken`, one for each triangle, of those that would be connected to the others around a node only
// through that node, which most models reject: of triangles that are connected around a node in `mesh`, the largest
// connected set stays. Returns their number.
std::size_t leaveOutLooseFans(const TriMesh& mesh, std::vector<std::uint8_t>& taken, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
