// Work that waits for the disk is done once for each item.
#include "apps/process/waiting_threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace coastmesh {
namespace {

TEST(WaitingThreads, DoEachItemOnce) {
  for (const std::size_t count : {0u, 1u, 7u, 8u, 100u, 5000u}) {
    std::vector<std::atomic<int>> done(count);
    onWaitingThreads(count, [&](std::size_t i) { ++done[i]; });
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(done[i], 1) << i << " of " << count;
  }
}

}  // namespace
}  // namespace coastmesh
