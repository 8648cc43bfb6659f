#pragma once

#include <algorithm>
#include <vector>

#include "core/bulk_list.hpp"

namespace coastmesh {

template <typename Item>
bool operator==(const BulkList<Item>& one, const std::vector<Item>& other) {
  return std::ranges::equal(one, other);
}

}  // namespace coastmesh
