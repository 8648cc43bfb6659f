#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"

namespace coastmesh {

// Items 0 to `count` sorted by part.
struct Distribution {
  BulkList<std::uint32_t> items;      // those of one part in ascending order
  std::vector<std::uint32_t> starts;  // of the parts in `items`, then its end
};

// Sorts items by `partOf(i)`, which is below `parts`, on several threads. REQUIRES: at most 65,536 parts.
template <typename PartOf>
Distribution distribute(const ItemLoop& loop, std::size_t count, std::size_t parts, const PartOf& partOf) {
  BulkList<std::uint16_t> part = unsetList<std::uint16_t>(count);
  // The number of items of each part in each range; then the place of the next.
  auto places = overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> here(parts, 0);
    for (std::size_t i = first; i < last; ++i) {
      part[i] = static_cast<std::uint16_t>(partOf(i));
      ++here[part[i]];
    }
    return here;
  });
  Distribution sorted;
  sorted.starts.reserve(parts + 1);
  std::uint32_t start = 0;
  for (std::size_t p = 0; p < parts; ++p) {
    sorted.starts.push_back(start);
    for (std::vector<std::uint32_t>& here : places) start += std::exchange(here[p], start);
  }
  sorted.starts.push_back(start);
  resizeUnset(sorted.items, count);
  forEachStretch(loop, count, places.size(), [&](std::size_t s, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) sorted.items[places[s][part[i]]++] = static_cast<std::uint32_t>(i);
  });
  return sorted;
}

}  // namespace coastmesh
