#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace coastmesh {

// Closes the gaps in a list of `count` items with items from its end, so that all others keep their numbers: calls
// `move(from, to)` for each item that fills a hole, and returns the number of items left. `holes` is ascending.
template <typename Move>
std::size_t fillHoles(std::span<const std::uint32_t> holes, std::size_t count, const Move& move) {
  const std::size_t left = count - holes.size();
  std::size_t next = 0, last_hole = holes.size();
  for (std::size_t from = count; from-- > left;) {
    if (last_hole > 0 && holes[last_hole - 1] == from) {
      --last_hole;
    } else {
      move(static_cast<std::uint32_t>(from), holes[next++]);
    }
  }
  return left;
}

}  // namespace coastmesh
