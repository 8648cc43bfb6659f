#include "gis/file/whole_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "gis/error.hpp"

namespace coastmesh {
namespace {

class WholeFile : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  // `count` bytes, each unlike its neighbours; kLengths has lengths at and near multiples of the allocated blocks.
  static std::string bytes(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text.push_back(static_cast<char>(i * 131 + (i >> 8)));
    return text;
  }
  void write(const std::string& content) const {
    std::ofstream file(path_, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
  }

  const std::string path_ = ::testing::TempDir() + "/whole_file_" + std::to_string(::getpid());
};

constexpr std::size_t kLengths[] = {0, 1, 4095, 4096, 4097, 8192, 100000};

TEST_F(WholeFile, HasEveryByte) {
  for (const std::size_t length : kLengths) {
    write(bytes(length));
    EXPECT_EQ(wholeFile(path_), bytes(length)) << length;
  }
}

TEST_F(WholeFile, MayBeAPipe) {
  for (const std::size_t length : kLengths) {
    std::filesystem::remove(path_);
    ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    std::thread writer([&] { write(bytes(length)); });
    EXPECT_EQ(wholeFile(path_), bytes(length)) << length;
    writer.join();
  }
}

TEST_F(WholeFile, OfWhatIsNoneSaysWhy) {
  const auto refusal = [](const std::string& path) -> std::string {
    try {
      wholeFile(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "read";
  };
  EXPECT_EQ(refusal(path_), "cannot read '" + path_ + "': No such file or directory");
  EXPECT_EQ(refusal(::testing::TempDir()), "cannot read '" + ::testing::TempDir() + "': Is a directory");
}

}  // namespace
}  // namespace coastmesh
