#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/file/output_files.hpp"

namespace coastmesh {

// One output of one or several files, written completely or not at all: written under the same names in a hidden folder
// beside the target, and moved into place by `commit`. The destructor removes what was not committed.
class StagedFiles {
 public:
  // Rejects a folder that does not exist, an existing file unless `overwrite`, and, even with `overwrite`, anything
  // other than a regular file: a folder, a device, a pipe, a link. Throws OutputError.
  StagedFiles(std::string path, OutputFiles files, bool overwrite);
  explicit StagedFiles(const std::string& path, bool overwrite) : StagedFiles(path, {{path}, {}, {}}, overwrite) {}
  ~StagedFiles();
  StagedFiles(StagedFiles&&) noexcept;
  StagedFiles& operator=(StagedFiles&&) = delete;

  // Calls `writer` with the staged path of the main file to make the files, replacing any made before. Throws what it
  // throws; an OutputError names the target instead of that path.
  void make(const std::function<void(const std::string& path)>& writer);
  void write(std::string_view content);  // throws OutputError
  // Drops the new `target` and keeps the existing one.
  void keep(const std::string& target);
  bool made() const { return made_; }

  void commit();  // like commitTogether

  const std::string& path() const { return path_; }
  bool mayReplace() const { return overwrite_; }
  // The folder of everything not committed yet; for emergency exits. Empty once moved from or committed.
  const std::string& stagingFolder() const { return staging_folder_; }

 private:
  friend void syncToDisk(std::span<StagedFiles* const> outputs, const ItemLoop& loop);
  friend void moveInTurn(std::span<const std::vector<StagedFiles*>> groups);
  void requireFree() const;
  template <typename Moves>
  void move(Moves& moves) const;

  std::string path_;
  OutputFiles files_;
  bool overwrite_;
  bool made_ = false;
  std::set<std::string> kept_;
  std::string staging_folder_;
};

// Waits until all files are on disk. Takes little longer for many files than for one if `loop` has threads to wait.
// REQUIRES: all are made. Throws OutputError, also for files that may not be replaced.
void syncToDisk(std::span<StagedFiles* const> outputs, const ItemLoop& loop = inOrder);

// Moves the outputs of one group after another into place, and syncs that to disk once, in the end. Of each group
// either all are in place or none; if one fails, those before it are in place, those after it are not; if it is syncing
// that fails, none is. REQUIRES: `syncToDisk` was called for all. Throws OutputError.
void moveInTurn(std::span<const std::vector<StagedFiles*>> groups);

// Syncs all files to disk, moves them into place, and syncs that too. Either all are in place or, if one fails, none:
// the previous ones are then restored. REQUIRES: all are made. Throws OutputError.
void commitTogether(std::span<StagedFiles* const> outputs);

}  // namespace coastmesh
