#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"

namespace coastmesh {

// Every edge of the triangles once, the lesser node first, in lexicographic order.
BulkList<std::array<std::uint32_t, 2>> uniqueEdges(std::size_t nodes,
                                                   std::span<const std::array<std::uint32_t, 3>> triangles,
                                                   const ItemLoop& loop = inOrder);

}  // namespace coastmesh
