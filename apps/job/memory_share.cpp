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
  double bytes = 0.0;
  const auto add = [&bytes](const auto& array) { bytes += static_cast<double>(array.size() * sizeof(array[0])); };
  forEachNodeArray(grid, add);
  std::apply([&add](const auto&... arrays) { (add(arrays), ...); }, triangleArrays(grid));
  return bytes;
}

}  // namespace coastmesh
