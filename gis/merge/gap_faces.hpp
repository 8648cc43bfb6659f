#pragma once

#include <array>
#include <compare>
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

// Where the outline passes an edge of a line of the first mesh: the line goes from `from` to `node` of the outline, no
// more to `gone`.
struct LineEnd {
  std::uint32_t from = kNone, gone = kNone, node = kNone;

  friend auto operator<=>(const LineEnd&, const LineEnd&) = default;
};

// Triangles between nodes of two meshes, in a numbering of both: the nodes of the first, then those of the second. A
// node that both have is the second's.
struct GapFaces {
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise
  std::vector<NodePair> shore;                          // sorted keys of edges of the first mesh's boundary
  std::vector<LineEnd> line_ends;                       // sorted
};

// Fills the gap between the outline of an inserted mesh and the `Free` triangles of the other, where that has water,
// or one of `holes` (loops of its boundary) that is open all around. No node is added: the triangles are those of the
// constrained Delaunay triangulation of the outline and of the nodes around it. Nodes of the other mesh that are too
// close to the outline, and not corners of `Free` triangles, are left out. So are triangles that touch edges of the
// outline that do not join, or nodes between two of these, so that these stay boundary. `lines`, sorted keys, are
// edges of the mesh that stay, unless the outline passes them. REQUIRES: the arguments are those and the result of
// `coverOf`. Throws BadPslg if edges cross one another.
GapFaces fillGap(const TriMesh& mesh, std::span<const std::uint32_t> same, std::span<const Cover> cover,
                 std::span<const std::vector<VertexId>> holes, std::span<const NodePair> lines, const Outline& outline,
                 const ItemLoop& loop = inOrder);

}  // namespace coastmesh
