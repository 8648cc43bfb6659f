#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Elements on the other side of a cut than they were.
struct EvenedCut {
  std::size_t given = 0;     // to the rest
  std::size_t taken_in = 0;  // from the rest
};

// Makes the edge between what is taken and the rest even, so that most models accept both: an element that sticks out
// of one of them with two sides, or that only a node connects to the others, becomes the other one's. What is taken and
// the rest are treated alike, so that cuts with flags and with the opposite ones still fit one another. First sets
// around a node, of which there are more than two, those that have not moved and the smallest first; then teeth, once,
// unless their neighbour is one too; then sets and elements without a neighbour that this leaves. Where nodes close to
// one another cannot all be settled, `tidyEvenCut` has to follow. Nothing, without a change, if all or none would be
// taken.
// `other_half`, of `otherHalves`: quadrilaterals move whole, and are teeth with three sides. REQUIRES: both halves of
// each have the same flag.
std::optional<EvenedCut> evenCut(const TriMesh& mesh, std::span<const std::uint32_t> other_half,
                                 std::vector<std::uint8_t>& taken, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
