#pragma once

#include <cstddef>
#include <functional>

namespace coastmesh::testing {

// A loop over its items from last to first, which exposes dependence on the order of work.
inline void backwards(std::size_t count, const std::function<void(std::size_t)>& work) {
  while (count > 0) work(--count);
}

}  // namespace coastmesh::testing
