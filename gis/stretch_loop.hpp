#pragma once

#include <cstddef>
#include <functional>

namespace coastmesh {

// Calls `work(first, last)` for stretches that make up 0 to `count`, in any order or at the same time: who calls lends this room its
// threads.
using StretchLoop =
    std::function<void(std::size_t count, const std::function<void(std::size_t first, std::size_t last)>& work)>;

inline void inOneStretch(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
  work(0, count);
}

}  // namespace coastmesh
