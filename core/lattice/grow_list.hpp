#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// Makes room for `count` items, and for `spare` more whose memory is not touched. If the list has to move, all threads
// touch the new memory first; `reserve` would touch it on one thread, while copying.
template <typename Item>
void growOn(const ItemLoop& loop, std::vector<Item>& items, std::size_t count, std::size_t spare = 0) {
  if (count <= items.capacity()) return;
  std::vector<Item> grown;
  reserveOn(loop, grown, count, spare);
  grown.insert(grown.end(), items.begin(), items.end());
  items = std::move(grown);
}

}  // namespace coastmesh
