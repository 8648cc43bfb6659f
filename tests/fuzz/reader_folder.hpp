#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace coastmesh {

// An empty folder for one test, removed at its end.
class ReaderFolder {
 public:
  ReaderFolder() : path_(::testing::TempDir() + "/readers_" + std::to_string(::getpid())) {
    std::filesystem::create_directories(path_);
  }
  ~ReaderFolder() { std::filesystem::remove_all(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace coastmesh
