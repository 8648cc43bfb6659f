#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"

namespace coastmesh {

struct IndexBox {
  Point low;
  Point high;
};

// Rows with boxes, in an order in which consecutive ones are close together.
struct TileOrder {
  std::vector<std::uint32_t> rows;
  IndexBox bounds;  // of all boxes
};

// Sort-tile-recursive order (Leutenegger, Lopez & Edgington 1997) of rows 0 to `rows` - 1: slices of x, each sorted by
// y, so that `together` consecutive rows make a compact node of a tree. Sorts middles of boxes, rounded to 2^-32 of the
// bounds. `box` is called from several threads at the same time. REQUIRES: rows > 0.
TileOrder tileOrder(std::uint32_t rows, std::size_t together, const std::function<IndexBox(std::uint32_t row)>& box,
                    const ItemLoop& loop);

}  // namespace coastmesh
