#include "apps/cli/shard_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "tests/gis/grid_samples.hpp"

namespace coastmesh {

namespace {

// The header is longer than the part of the file that is read first.
TEST(ShardFile, AHeaderMayNameThousandsOfInputs) {
  const testing::TemporaryFolder folder;
  const std::string path = folder / "a.shard";
  GivenOptions options;
  for (int i = 0; i < 12'000; ++i) options.emplace_back("INPUT", std::string(1000, 'x') + std::to_string(i));
  ShardWriter shard(options, 2, 7);
  shard.begin(5, 11);
  const std::string bytes = shard.file(1);
  std::ofstream(path, std::ios::binary) << bytes;
  const std::optional<ShardHeader> header = headerOfWholeShard(path);
  ASSERT_TRUE(header);
  EXPECT_EQ(header->options, options);
  EXPECT_EQ(header->shard, 2u);
  EXPECT_EQ(header->groups, 11u);
  EXPECT_EQ(header->exit_code, 1);
  for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, std::size_t{1} << 20, std::size_t{3}}) {
    std::filesystem::resize_file(path, size);
    EXPECT_FALSE(headerOfWholeShard(path)) << size;
  }
}

}  // namespace

}  // namespace coastmesh
