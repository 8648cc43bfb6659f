#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/cli/shard_file.hpp"
#include "apps/job/mesh_job_result.hpp"
#include "parallel/region_checkpoint.hpp"

namespace coastmesh {

// A file that a run reads, by what changes where somebody writes to it. Of what is no regular file, the path alone.
struct FileStamp {
  std::string path;
  std::uint64_t bytes = 0;
  std::int64_t changed_ns = 0;

  bool operator==(const FileStamp&) const = default;
};
FileStamp stampOf(const std::string& path);

// What a run has to have in common with the one that it goes on from.
struct CheckpointHeader {
  std::string version;
  GivenOptions options;
  std::uint32_t shard = 0, shards = 1;
  std::vector<FileStamp> files;
  std::uint64_t input_digest = 0;
  std::uint64_t groups = 0;
};

// The folder of --checkpoint: each group that is done, and of those that are not the mesh after their last round. What
// is kept there is whole or is not there, however the process ends. One run at a time has it.
class CheckpointFolder {
 public:
  // Makes the folder where it is not there; else it has to be empty, or of a run with the same header, as far as that
  // is known before the input is read. Throws OptionError, InputError for a file that has changed or what is damaged,
  // and OutputError, as all below.
  CheckpointFolder(const std::string& folder, CheckpointHeader header);
  // Leaves what is kept.
  ~CheckpointFolder();
  CheckpointFolder(const CheckpointFolder&) = delete;
  CheckpointFolder& operator=(const CheckpointFolder&) = delete;

  // Once the input is read.
  void begin(std::uint64_t input_digest, std::size_t groups);
  // The rest from several threads.
  bool has(std::size_t group) const { return places_.contains(group); }  // from an earlier run
  GroupResult take(std::size_t group);
  // Unless it was there already, or lacks memory: then another run may do it.
  void keep(std::size_t group, const GroupResult& result);
  RegionCheckpoint rounds(std::size_t group);
  CheckpointUse use() const;
  // What to do where what is kept cannot be used, as the end of a sentence.
  std::string remedy() const;

  // The run is done: nothing is kept any more, and the folder goes where nothing else is in it. What cannot be removed
  // stays.
  void finish() { remove(true); }

 private:
  struct Place {
    std::uint64_t at = 0, size = 0;
  };

  void lock();
  void requireSameRun(const CheckpointHeader& kept) const;
  void readGroups();
  void removeKept() const;
  void remove(bool folder_too);
  void keepWhole(const std::string& name, const std::function<void(const RegionCheckpoint::Put&)>& write);
  bool restoreWhole(const std::string& name, const RegionCheckpoint::Read& read) const;

  std::filesystem::path folder_;
  CheckpointHeader header_;
  bool made_ = false;   // the folder, by this run
  bool begun_ = false;  // there is something to go on from
  int lock_ = -1, groups_ = -1;
  std::uint64_t groups_end_ = 0;
  std::unordered_map<std::size_t, Place> places_;  // in the file of groups
  std::mutex mutex_;                               // for what is appended to that
  std::atomic<std::uint64_t> groups_taken_ = 0, regions_gone_on_ = 0, rounds_kept_ = 0, bytes_kept_ = 0;
};

}  // namespace coastmesh
