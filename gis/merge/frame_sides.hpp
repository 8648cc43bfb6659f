#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/outline.hpp"

namespace coastmesh {

// Edges of an outline that are land in its mesh, although the other mesh goes on beyond them. Sorted.
struct FrameSides {
  std::vector<std::uint32_t> joined;  // sides of its frame across land that both meshes have: as good as open
  std::vector<std::uint32_t> closed;  // others that are hardly a shore
};

// A mesh with a flood plain ends on land at the sides of its frame, as a model of its own has to. Three signs tell a
// side from a shore: it is straight, with all of the outline to one side of it; the other mesh has triangles beyond it,
// for more than the length of an edge, where a shore of a coarser mesh would differ by less; and the triangles of both
// beside it lie above the water, or on the land of a flood plain. Where a side joins elsewhere, parts of it shorter
// than two edges of the other mesh need not have the last sign, which elements of different sizes show at different
// places. Longer parts and other straight sides without it are `closed`, and so are other edges beyond which the other
// mesh goes on above the water. Weirs and rivers are neither. `mesh` is that of `grid`, the other one; triangles with a
// flag in `is_far`, which may be empty, do not count. `inserted_mesh` is that of `inserted`, whose outline it is; both
// are in one plane.
FrameSides frameSides(const Grid& grid, const TriMesh& mesh, std::span<const std::uint8_t> is_far, const Grid& inserted,
                      const TriMesh& inserted_mesh, const Outline& outline, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
