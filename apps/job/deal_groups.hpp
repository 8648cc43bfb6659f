#pragma once

#include <cstdint>
#include <vector>

namespace coastmesh {

// Which of `shards` each group goes to, from the groups' points alone: the largest first, each to the shard that has
// the least work by then, the first of several.
std::vector<std::uint32_t> dealGroups(const std::vector<std::size_t>& points, std::uint32_t shards);

}  // namespace coastmesh
