#include "gis/file/room_on_disk.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::TemporaryFolder;

TEST(RoomOnDisk, IsThereAsARule) {
  const TemporaryFolder folder;
  EXPECT_EQ(whyNoRoom(folder / "file"), "");
  EXPECT_TRUE(folder.names().empty());
}

TEST(RoomOnDisk, IsUnknownWithoutTheFolder) {
  const TemporaryFolder folder;
  EXPECT_EQ(whyNoRoom(folder / "no/file"), "");
}

TEST(RoomOnDisk, EndsAtALimitThatAFileHasReached) {
  const TemporaryFolder folder;
  constexpr std::size_t kLimit = 1 << 20;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::ofstream(folder / "small", std::ios::binary) << std::string(kLimit / 2, 'x');
  rlimit limit = before;
  limit.rlim_cur = kLimit;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  const std::string with_room = whyNoRoom(folder / "file");
  std::ofstream(folder / "large", std::ios::binary) << std::string(kLimit - 10, 'x');
  const std::string without = whyNoRoom(folder / "file");
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(with_room, "");
  EXPECT_EQ(without, std::strerror(EFBIG));
}

}  // namespace
}  // namespace coastmesh
