#include "core/item_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

TEST(ItemLoop, SortOnSorts) {
  std::mt19937 random(1);
  for (const std::size_t count : {0u, 1u, 1000u, 32768u, 100003u}) {
    std::vector<std::uint64_t> items(count), sorted;
    for (std::size_t i = 0; i < count; ++i) items[i] = std::uint64_t{random()} << 32 | i;
    sorted = items;
    std::ranges::sort(sorted);
    for (const ItemLoop& loop : {ItemLoop(inOrder), ItemLoop(testing::backwards)}) {
      std::vector<std::uint64_t> other = items;
      sortOn(loop, other);
      EXPECT_EQ(other, sorted) << count;
    }
  }
}

}  // namespace
}  // namespace coastmesh
