#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "tests/fuzz/reader_cases.hpp"
#include "tests/fuzz/reader_folder.hpp"

namespace coastmesh {
namespace {

namespace fs = std::filesystem;

std::vector<std::uint8_t> bytesOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

// Files that once broke a reader: a case per file, a folder per reader.
std::vector<std::string> corpusFiles() {
  std::vector<std::string> files;
  for (const ReaderCase& reader : readerCases()) {
    const fs::path folder = fs::path(COASTMESH_CORPUS_DIR) / reader.name;
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      files.push_back(std::string(reader.name) + "/" + entry.path().filename().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

class ReaderCorpus : public ::testing::TestWithParam<std::string> {};

TEST_P(ReaderCorpus, IsReadOrRefused) {
  const fs::path file = GetParam();
  const ReaderFolder folder;
  const ReadOutcome outcome =
      runReader(readerCase(file.parent_path().string()), bytesOf(fs::path(COASTMESH_CORPUS_DIR) / file), folder.path());
  std::cout << (outcome.read ? "read" : outcome.refusal) << '\n';
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

INSTANTIATE_TEST_SUITE_P(All, ReaderCorpus, ::testing::ValuesIn(corpusFiles()), [](const auto& param_info) {
  std::string name = param_info.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

}  // namespace
}  // namespace coastmesh
