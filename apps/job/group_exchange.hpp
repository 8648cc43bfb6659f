#pragma once

#include <cstdint>
#include <functional>

namespace coastmesh {

struct GroupResult;

// Where groups' meshes go, and come from, where not all of them are made in this run.
struct GroupExchange {
  std::uint32_t shard = 0, shards = 1;  // only the groups that are dealt to `shard` are taken
  // Called once, when the input is read, with what says which input it is and how many groups it has. May throw.
  std::function<void(std::uint64_t input_digest, std::size_t groups)> begin;
  // Gives a group that was meshed before, less the projection of its plane; called from several threads. Empty: groups
  // are meshed here. May throw.
  std::function<GroupResult(std::size_t group)> take;
  // Called with each group that was meshed here, from several threads.
  std::function<void(std::size_t group, const GroupResult& result)> keep;
};

}  // namespace coastmesh
