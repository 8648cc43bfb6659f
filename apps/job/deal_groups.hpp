#pragma once

#include <cstdint>
#include <vector>

namespace coastmesh {

// The shard of each group, one of `shards`, from the groups' points alone: the largest group first, each to the first
// shard with the least work so far.
std::vector<std::uint32_t> dealGroups(const std::vector<std::size_t>& points, std::uint32_t shards);

}  // namespace coastmesh
