// coastmesh_reader_replay READER FILE...: prints for each file whether it is read, or why it is refused. Exit code 1 if
// a file is neither read nor refused correctly.
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/fuzz/reader_cases.hpp"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: coastmesh_reader_replay READER FILE...\n");
    return 2;
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("coastmesh_replay_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  int failed = 0;
  for (int i = 2; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    try {
      const coastmesh::ReadOutcome outcome = coastmesh::runReader(coastmesh::readerCase(argv[1]), bytes, folder);
      std::printf("%s: %s\n", argv[i], outcome.read ? "read" : outcome.refusal.c_str());
    } catch (const std::exception& error) {
      std::printf("%s: FAILED: %s\n", argv[i], error.what());
      failed = 1;
    }
  }
  std::filesystem::remove_all(folder);
  return failed;
}
