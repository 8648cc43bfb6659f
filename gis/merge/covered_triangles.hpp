#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/merge/outline.hpp"

namespace coastmesh {

// How an outline covers a triangle of another mesh.
enum class Cover : std::uint8_t {
  Free,   // not at all, though it may share nodes and edges with it
  Met,    // the outline crosses it, or is so close that a triangle between them would be a sliver
  Inside  // entirely
};

// For each triangle of `mesh`, whose nodes are at `mesh.points`. `same` has for each node the node of the outline that
// is the same, kNone if there is none: only by these do they touch. Triangles with a flag in `is_far`, which may be
// empty, are free.
std::vector<Cover> coverOf(const TriMesh& mesh, std::span<const std::uint32_t> same,
                           std::span<const std::uint8_t> is_far, const Outline& outline,
                           const ItemLoop& loop = inOrder);

}  // namespace coastmesh
