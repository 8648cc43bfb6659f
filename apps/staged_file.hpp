#pragma once

#include <filesystem>
#include <string>

#include "apps/interrupt.hpp"

namespace coastmesh {

// One output file, made whole or not at all: it is written aside, in a folder of its own beside the target, and moved
// into place by `commit`. The destructor removes what was not committed.
class StagedFile {
 public:
  // Refuses an existing target unless `overwrite`, and a folder that does not exist. Throws OutputError.
  StagedFile(std::string target, bool overwrite, Interrupt& interrupt);
  ~StagedFile();
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;

  // Where to write; has the target's own file name.
  std::string path() const { return (folder_ / target_.filename()).string(); }
  const std::filesystem::path& target() const { return target_; }

  void write(const std::string& content);  // throws OutputError
  void commit();                           // throws OutputError

 private:
  std::filesystem::path target_;
  bool overwrite_;
  Interrupt& interrupt_;
  std::filesystem::path folder_;
};

}  // namespace coastmesh
