#pragma once

#include <cstdint>
#include <functional>

namespace coastmesh {

struct GroupResult;
struct RegionCheckpoint;

// Where groups' meshes go, and come from, where not all of them are made in this run.
struct GroupExchange {
  std::uint32_t shard = 0, shards = 1;  // only the groups that are dealt to `shard` are taken
  // Called once, when the input is read, with what says which input it is and how many groups it has. May throw.
  std::function<void(std::uint64_t input_digest, std::size_t groups)> begin;
  // Gives a group that was meshed before; called from several threads. Empty: groups are meshed here. May throw.
  std::function<GroupResult(std::size_t group)> take;
  // Whether `take` has a group; those that it has not are meshed here. Empty: it has all.
  std::function<bool(std::size_t group)> has;
  // Called with each group, from several threads. May throw.
  std::function<void(std::size_t group, const GroupResult& result)> keep;
  // Where a group's mesh is kept from round to round, and gone on with. Empty: nowhere. May throw.
  std::function<RegionCheckpoint(std::size_t group)> checkpoint;
};

}  // namespace coastmesh
