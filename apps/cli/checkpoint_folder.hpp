#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "apps/cli/shard_file.hpp"
#include "apps/job/mesh_job_result.hpp"
#include "parallel/region_checkpoint.hpp"

namespace coastmesh {

// The state of a file that a run reads; it changes when the file is written. Only the path if it is no regular file.
struct FileStamp {
  std::string path;
  std::uint64_t bytes = 0;
  std::int64_t changed_ns = 0;

  bool operator==(const FileStamp&) const = default;
};
FileStamp stampOf(const std::string& path);

// What a run must have in common with the one that it resumes.
struct CheckpointHeader {
  std::string version;
  GivenOptions options;
  std::uint32_t shard = 0, shards = 1;
  std::vector<FileStamp> files;
  std::uint64_t input_digest = 0;
  std::uint64_t groups = 0;
};

// The folder of --checkpoint: finished groups, and of unfinished ones the mesh after their last round. Each is saved
// completely or not at all, however the process ends. Locked by one run at a time.
class CheckpointFolder {
 public:
  // Makes the folder if it does not exist; otherwise it must be empty, or of a run with the same header as far as that
  // is known before the input is read. Throws OptionError, InputError if a file has changed or what was saved is
  // damaged, and OutputError, as do all functions below.
  CheckpointFolder(const std::string& folder, CheckpointHeader header);
  // Keeps what was saved; if nothing was begun, removes what the constructor made.
  ~CheckpointFolder();
  CheckpointFolder(const CheckpointFolder&) = delete;
  CheckpointFolder& operator=(const CheckpointFolder&) = delete;

  // Notes the folders of this run's unfinished outputs, and removes those of the run before: if that was killed, it has
  // left them.
  void replaceUnfinished(const std::vector<std::filesystem::path>& folders);
  // To be called once the input is read.
  void begin(std::uint64_t input_digest, std::size_t groups);
  // The functions below may be called from several threads.
  bool has(std::size_t group) const { return places_.contains(group); }  // from an earlier run
  GroupResult take(std::size_t group);
  // Does nothing if the group was taken from an earlier run, or if it lacks memory: another run may mesh it.
  void keep(std::size_t group, const GroupResult& result);
  RegionCheckpoint rounds(std::size_t group);
  CheckpointUse use() const;
  // What to do if the saved files cannot be used, as the end of a sentence.
  std::string remedy() const;

  // The run is done: removes what was saved, and the folder if nothing else is in it. Ignores errors.
  void finish() { remove(true); }

 private:
  struct Place {
    std::uint64_t at = 0, size = 0;
  };

  void lock();
  void requireSameRun(const CheckpointHeader& kept) const;
  void requireSameFiles(const std::vector<FileStamp>& kept) const;
  void readGroups();
  void removeKept(std::string_view besides = {}) const;
  void remove(bool folder_too);
  void keepWhole(const std::string& name, const std::function<void(const RegionCheckpoint::Put&)>& write);
  bool restoreWhole(const std::string& name, const RegionCheckpoint::Read& read) const;

  std::filesystem::path folder_;
  CheckpointHeader header_;
  bool made_ = false;   // this run made the folder
  bool begun_ = false;  // there is a run to resume
  int lock_ = -1, groups_ = -1;
  std::uint64_t groups_end_ = 0;
  std::unordered_map<std::size_t, Place> places_;  // in the file of groups
  std::mutex mutex_;                               // guards appending to that file
  std::atomic<std::uint64_t> groups_taken_ = 0, regions_gone_on_ = 0, rounds_kept_ = 0, bytes_kept_ = 0;
};

}  // namespace coastmesh
