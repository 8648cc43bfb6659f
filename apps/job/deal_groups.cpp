#include "apps/job/deal_groups.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace coastmesh {

std::vector<std::uint32_t> dealGroups(const std::vector<std::size_t>& points, std::uint32_t shards) {
  // Fixed cost of a group, in points.
  constexpr std::uint64_t kPointsOfAny = 20;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&points](std::size_t group) { return points[group]; });
  using Load = std::pair<std::uint64_t, std::uint32_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::uint32_t shard = 0; shard < shards; ++shard) loads.emplace(0, shard);
  std::vector<std::uint32_t> shard_of(points.size(), 0);
  for (const std::size_t group : order) {
    const auto [load, shard] = loads.top();
    loads.pop();
    shard_of[group] = shard;
    loads.emplace(load + points[group] + kPointsOfAny, shard);
  }
  return shard_of;
}

}  // namespace coastmesh
