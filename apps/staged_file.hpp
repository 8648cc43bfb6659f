#pragma once

#include <filesystem>
#include <functional>
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

  void write(const std::string& content);  // throws OutputError
  // Lets `writer` make the file under the path that it is given, which ends in the target's own name. Throws what it
  // throws, with the target in place of that path.
  void make(const std::function<void(const std::string& path)>& writer);
  void commit();  // throws OutputError

 private:
  std::string path() const { return (folder_ / target_.filename()).string(); }

  std::filesystem::path target_;
  bool overwrite_;
  Interrupt& interrupt_;
  std::filesystem::path folder_;
};

}  // namespace coastmesh
