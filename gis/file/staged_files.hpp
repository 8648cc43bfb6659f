#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "gis/file/output_files.hpp"

namespace coastmesh {

// One output of one file or of several, made whole or not at all: written aside under the same names in a hidden folder
// beside the target, and moved into place by `commit`. The destructor removes what was not committed.
class StagedFiles {
 public:
  // Refuses a folder that does not exist, an existing file unless `overwrite`, and whatever `overwrite` says what is no
  // regular file: a folder, a device, a pipe, a link. Throws OutputError.
  StagedFiles(std::string path, OutputFiles files, bool overwrite);
  explicit StagedFiles(const std::string& path, bool overwrite) : StagedFiles(path, {{path}, {}, {}}, overwrite) {}
  ~StagedFiles();
  StagedFiles(StagedFiles&&) noexcept;
  StagedFiles& operator=(StagedFiles&&) = delete;

  // Lets `writer` make the files, given the path of the main one, in place of any made before. Throws what it throws;
  // an OutputError names the target in place of that path.
  void make(const std::function<void(const std::string& path)>& writer);
  void write(std::string_view content);  // throws OutputError
  // Drops `target` of what was made and leaves the one that is there already.
  void keep(const std::string& target);
  bool made() const { return made_; }

  void commit();  // as commitTogether

  const std::string& path() const { return path_; }
  bool mayReplace() const { return overwrite_; }
  // Holds everything that is not committed yet; for whoever has to end at once. Empty once moved from or committed.
  const std::string& stagingFolder() const { return staging_folder_; }

 private:
  friend void commitTogether(std::span<StagedFiles* const> outputs);
  void requireFree() const;
  void checkAndFlush() const;
  template <typename Moves>
  void move(Moves& moves) const;

  std::string path_;
  OutputFiles files_;
  bool overwrite_;
  bool made_ = false;
  std::set<std::string> kept_;
  std::string staging_folder_;
};

// Waits until all files are on the disk, moves them into place, and waits for that too. All come into place or, where
// one cannot, none: then those that were there before are put back. REQUIRES: all are made. Throws OutputError.
void commitTogether(std::span<StagedFiles* const> outputs);

}  // namespace coastmesh
