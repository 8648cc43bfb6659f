#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Elements left out for the sake of models.
struct TidiedCut {
  std::size_t loose = 0;  // connected to the others around a node only through that node
  std::size_t teeth = 0;  // stuck out of the cut with two sides, or had no neighbour left: before, or without these
};

// Clears the flags in `taken`, one for each triangle, of those that most models would reject at the edge of what is
// taken: first of loose ones, where the largest set that is connected around a node stays; then of teeth, once, unless
// their neighbour is one too; then of those that this leaves loose or alone. Triangles that are loose, or alone, in
// `mesh` already are left as they are. Some triangle stays.
// `other_half`, of `otherHalves`: quadrilaterals are taken or left out whole, and are teeth with three sides. REQUIRES:
// both halves of each have the same flag.
TidiedCut tidyCut(const TriMesh& mesh, std::span<const std::uint32_t> other_half, std::vector<std::uint8_t>& taken,
                  const ItemLoop& loop = inOrder);

// The same after `evenCut`, which leaves nothing but what it could not settle: teeth stay.
TidiedCut tidyEvenCut(const TriMesh& mesh, std::span<const std::uint32_t> other_half, std::vector<std::uint8_t>& taken,
                      const ItemLoop& loop = inOrder);

}  // namespace coastmesh
