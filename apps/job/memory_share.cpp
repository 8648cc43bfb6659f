#include "apps/job/memory_share.hpp"

#include <algorithm>
#include <tuple>

namespace coastmesh {

double memoryShare(double whole, std::size_t points, const Together& together) {
  if (together.groups <= 1) return whole;
  // One half is shared equally, the other by points: large groups mostly have many.
  const auto alike = static_cast<double>(std::clamp<std::size_t>(together.at_a_time, 1, together.groups));
  const auto all = static_cast<double>(std::max<std::size_t>(together.points, 1));
  return whole * 0.5 * (1.0 / alike + static_cast<double>(points) / all);
}

double bytesHeldBy(const Grid& grid) {
  const auto sum = [](const auto&... arrays) {
    return (0.0 + ... + static_cast<double>(arrays.size() * sizeof(arrays[0])));
  };
  return std::apply(sum, nodeArrays(grid)) + std::apply(sum, triangleArrays(grid));
}

}  // namespace coastmesh
