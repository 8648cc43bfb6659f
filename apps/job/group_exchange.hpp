#pragma once

#include <cstdint>
#include <functional>

namespace coastmesh {

struct GroupResult;
struct RegionCheckpoint;

// Where groups' meshes are sent to, and come from, if not all of them are made in this run.
struct GroupExchange {
  std::uint32_t shard = 0, shards = 1;  // only the groups of `shard` are meshed
  // Called once, when the input has been read, with its digest and its number of groups. May throw.
  std::function<void(std::uint64_t input_digest, std::size_t groups)> begin;
  // Returns a group that was meshed before; called from several threads. Empty: groups are meshed here. May throw.
  std::function<GroupResult(std::size_t group)> take;
  // True if `take` has a group; otherwise it is meshed here. Empty: it has all.
  std::function<bool(std::size_t group)> has;
  // Called with each group, from several threads. May throw. A group that `lacks_memory` may be meshed by another run.
  std::function<void(std::size_t group, const GroupResult& result)> keep;
  // Where a group's mesh is saved after each round, and resumed from. Empty: nowhere. May throw.
  std::function<RegionCheckpoint(std::size_t group)> checkpoint;
};

}  // namespace coastmesh
