#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/item_loop.hpp"

namespace coastmesh {

// Writes a table (CSV) of the numbers that nodes and triangles had in a mesh before it was changed, with the columns
// "item,number,source": "node" or "triangle", its number, and that before, counted from 1; no source for kNone. Throws
// OutputError.
void writeNumberTable(std::span<const std::uint32_t> nodes, std::span<const std::uint32_t> triangles,
                      const std::string& path, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
