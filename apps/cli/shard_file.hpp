#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/job/group_exchange.hpp"
#include "apps/job/mesh_group.hpp"
#include "apps/usage/option_table.hpp"

namespace coastmesh {

// A file of the groups that one shard of a run meshed, for `gather`: .shard.

bool isShardFile(const std::string& path);
// Those that are not, in their order.
std::vector<std::string> withoutShardFiles(const std::vector<std::string>& paths);

// What was given of the options that decide what a mesh is, by name.
using GivenOptions = std::vector<std::pair<std::string, OptionValue>>;
// Of `table`, those that `of_job` declares too, less --threads.
GivenOptions givenOptions(const OptionTable& table, const OptionTable& of_job);

// What stands before the groups.
struct ShardHeader {
  std::string version;
  GivenOptions options;
  std::uint32_t shard = 0, shards = 1;
  std::int32_t exit_code = 0;  // of the run that made it
  std::uint64_t input_digest = 0;
  std::uint64_t groups = 0;  // of the whole
  std::uint64_t left = 0;    // of its own: for lack of memory they are not in it, and `gather` meshes them

  bool ofSameRun(const ShardHeader& other) const {
    return version == other.version && options == other.options && shards == other.shards;
  }
};

// `bytes` with a checksum behind them, as the file of a shard ends.
std::string sealedShard(std::string bytes);

// Of a file that is whole, by its checksum; none for one that is damaged or cut short. Throws InputError for what is no
// shard file of this version.
std::optional<ShardHeader> headerOfWholeShard(const std::string& path);

// Takes the groups of a run as they are made.
class ShardWriter {
 public:
  ShardWriter(GivenOptions options, std::uint32_t shard, std::uint32_t shards);

  void begin(std::uint64_t input_digest, std::size_t groups);
  // From several threads. Of a group that lacks memory only that it does.
  void keep(std::size_t group, const GroupResult& result);
  std::string file(int exit_code) const;

 private:
  ShardHeader header_;
  std::mutex mutex_;
  std::vector<std::pair<std::uint64_t, std::string>> groups_;
};

// All shards of a run.
class GatheredShards {
 public:
  // Throws InputError where they are damaged, not those of one run, or one is missing or there twice.
  explicit GatheredShards(const std::vector<std::string>& paths);

  const GivenOptions& options() const { return header_.options; }
  // Throws InputError where the shards were made of another input.
  void begin(std::uint64_t input_digest, std::size_t groups) const;
  // From several threads. Those that lacked memory are not there.
  bool has(std::size_t group) const { return !places_.at(group).bytes.empty(); }
  GroupResult take(std::size_t group) const;  // throws InputError

 private:
  struct Place {
    std::size_t file = 0;
    std::string_view bytes;
  };
  std::vector<std::string> paths_, contents_;
  ShardHeader header_;                     // of the first
  std::map<std::uint64_t, Place> places_;  // by group
};

}  // namespace coastmesh
