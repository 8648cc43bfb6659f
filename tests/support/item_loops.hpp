#pragma once

#include <cstddef>
#include <functional>

namespace coastmesh::testing {

// A loop that takes its items from the last to the first: what depends on the order of work shows.
inline void backwards(std::size_t count, const std::function<void(std::size_t)>& work) {
  while (count > 0) work(--count);
}

}  // namespace coastmesh::testing
