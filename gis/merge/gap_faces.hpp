#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/error.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/merge/covered_triangles.hpp"
#include "gis/merge/outline.hpp"

namespace coastmesh {

// Triangles between nodes of two meshes, in a numbering of both: the nodes of the first, then those of the second. A
// node that both have is the second's.
struct GapFaces {
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise
  std::vector<NodePair> shore;                          // sorted keys of edges of the first mesh's boundary
};

// Fills the gap between the outline of an inserted mesh and the `Free` triangles of the other, where that has water, or
// one of `holes` (loops of its boundary) that is open all around. No node is added: the triangles are those of the
// constrained Delaunay triangulation of the outline and of the nodes around it. Nodes of the other mesh that are too
// close to the outline, and not corners of `Free` triangles, are left out. So are triangles that touch edges of the
// outline that do not join, or nodes between two of these, so that these stay boundary.
// REQUIRES: the arguments are those and the result of `coverOf`. Throws InputError if edges cross one another.
GapFaces fillGap(const TriMesh& mesh, std::span<const std::uint32_t> same, std::span<const Cover> cover,
                 std::span<const std::vector<VertexId>> holes, const Outline& outline, const ItemLoop& loop = inOrder);

// For a gap that cannot be triangulated.
InputError cannotJoin(const BadPslg& error);

}  // namespace coastmesh
