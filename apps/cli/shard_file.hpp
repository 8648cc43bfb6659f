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
#include "apps/job/group_task.hpp"
#include "apps/usage/option_table.hpp"

namespace coastmesh {

// A .shard file: the groups that one shard of a run meshed, for `gather`.

bool isShardFile(const std::string& path);
// The paths of other files, in their order.
std::vector<std::string> withoutShardFiles(const std::vector<std::string>& paths);

// The given options that determine a mesh: name and value.
using GivenOptions = std::vector<std::pair<std::string, OptionValue>>;
// Those of `table` that `of_job` declares too, without --threads.
GivenOptions givenOptions(const OptionTable& table, const OptionTable& of_job);

// Precedes the groups in the file.
struct ShardHeader {
  std::string version;
  GivenOptions options;
  std::uint32_t shard = 0, shards = 1;
  std::int32_t exit_code = 0;  // of the run that made it
  std::uint64_t input_digest = 0;
  std::uint64_t groups = 0;  // of the whole run
  std::uint64_t left = 0;    // groups of this shard that are missing for lack of memory: `gather` meshes them

  bool ofSameRun(const ShardHeader& other) const {
    return version == other.version && options == other.options && shards == other.shards;
  }
};

// `bytes` followed by their checksum, as a shard file ends.
std::string sealedShard(std::string bytes);

// The header of a complete file, by its checksum; nullopt if the file is damaged or cut short. Throws InputError for a
// file that is no shard file of this version.
std::optional<ShardHeader> headerOfWholeShard(const std::string& path);

// Collects the groups of a run as they are made.
class ShardWriter {
 public:
  ShardWriter(GivenOptions options, std::uint32_t shard, std::uint32_t shards);

  void begin(std::uint64_t input_digest, std::size_t groups);
  // May be called from several threads. Of a group that lacks memory, only that is recorded.
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
  // Throws InputError if files are damaged or of different runs, or if a shard is missing or given twice.
  explicit GatheredShards(const std::vector<std::string>& paths);

  const GivenOptions& options() const { return header_.options; }
  // Throws InputError if the shards were made from another input.
  void begin(std::uint64_t input_digest, std::size_t groups) const;
  // May be called from several threads. False for groups that lacked memory.
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
