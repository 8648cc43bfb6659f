#include "gis/file/file_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>

#include "gis/error.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

std::vector<char> bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

char byteAt(std::uint64_t at) { return static_cast<char>(at * 0x9E3779B97F4A7C15ull >> 56); }

// Parts with arbitrary ends, adjacent or apart, within a file's existing content.
void expectWritten(const ItemLoop& loop, std::uint64_t large_file) {
  constexpr std::uint64_t kSize = 40'000'001;  // several times as much as is written at once
  const testing::TemporaryFolder folder;
  const std::string path = folder / "parts";
  std::vector<char> expected(kSize, 'x');
  std::ofstream(path, std::ios::binary).write(expected.data(), kSize);
  std::vector<FilePart> parts;
  for (const auto& [begin, end] : std::vector<std::pair<std::uint64_t, std::uint64_t>>{{6'000'003, 9'000'000},
                                                                                       {13, 13},
                                                                                       {5, 4096},
                                                                                       {4096, 4100},
                                                                                       {4'194'304, 6'000'003},
                                                                                       {7'000, 2'097'153},
                                                                                       {9'000'001, 39'999'999}}) {
    for (std::uint64_t at = begin; at < end; ++at) expected[at] = byteAt(at);
    parts.push_back({begin, end - begin, [begin = begin](std::uint64_t first, std::span<std::byte> bytes) {
                       for (std::size_t i = 0; i < bytes.size(); ++i)
                         bytes[i] = static_cast<std::byte>(byteAt(begin + first + i));
                     }});
  }
  writeParts(path, parts, loop, large_file);
  EXPECT_EQ(bytesOf(path), expected);
}

TEST(WriteParts, PutsEachPartInItsPlaceAndLeavesTheRest) {
  expectWritten(inOrder, kLargeFile);
  expectWritten(testing::backwards, kLargeFile);
}

TEST(WriteParts, PutsThemInPlacePastTheCache) {
  expectWritten(inOrder, 0);
  expectWritten(testing::backwards, 0);
}

// Writes of earlier parts may be under way.
TEST(WriteParts, PassesOnTheErrorOfAPartThatCannotBeMade) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder / "parts").close();
  constexpr std::uint64_t kSize = 50'000'000;
  const auto fill = [](std::uint64_t first, std::span<std::byte> bytes) {
    if (first >= kSize / 2) throw OutputError("a part cannot be made");
    std::ranges::fill(bytes, std::byte{1});
  };
  EXPECT_THROW(writeParts(folder / "parts", {{4096, kSize, fill}}, inOrder, 0), OutputError);
}

TEST(WriteParts, NamesTheFileThatCannotBeWritten) {
  const testing::TemporaryFolder folder;
  const std::vector<FilePart> parts{{0, 1, [](std::uint64_t, std::span<std::byte>) {}}};
  try {
    writeParts(folder / "missing", parts, inOrder);
    FAIL() << "nothing was thrown";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("missing"), std::string::npos) << error.what();
  }
}

TEST(WriteParts, StopsWhereTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::vector<FilePart> parts{{0, 100, [](std::uint64_t, std::span<std::byte>) {}}};
  EXPECT_THROW(writeParts("/dev/full", parts, inOrder), OutputError);
}

}  // namespace
}  // namespace coastmesh
