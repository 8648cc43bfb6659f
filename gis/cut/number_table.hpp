#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/item_loop.hpp"
#include "gis/elements/elements.hpp"

namespace coastmesh {

// Writes a table (CSV) of the numbers that nodes and elements had in a mesh before it was changed, with the columns
// "item,number,source": "node", "triangle" or "quadrilateral", its number, and that before, counted from 1; no source
// for kNone. `sources`: one for each of the elements. Throws OutputError.
void writeNumberTable(std::span<const std::uint32_t> nodes, const Elements& elements,
                      std::span<const std::uint32_t> sources, const std::string& path, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
