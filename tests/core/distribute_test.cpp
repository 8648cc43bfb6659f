#include "core/distribute.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "tests/support/bulk_lists.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

TEST(Distribute, SortsByPartAndKeepsTheOrderWithinOne) {
  std::mt19937 random(3);
  for (const std::size_t count : {0u, 1u, 5000u, 60001u}) {
    for (const std::uint32_t parts : {1u, 7u, 1000u}) {
      std::vector<std::uint32_t> part(count);
      for (std::uint32_t& p : part)
        p = static_cast<std::uint32_t>(random()) % parts / 2 * 2;  // every other part is empty
      std::vector<std::uint32_t> expected(count);
      std::iota(expected.begin(), expected.end(), 0u);
      std::ranges::stable_sort(expected, {}, [&](std::uint32_t i) { return part[i]; });
      for (const ItemLoop& loop : {ItemLoop(inOrder), ItemLoop(testing::backwards)}) {
        const Distribution sorted = distribute(loop, count, parts, [&](std::size_t i) { return part[i]; });
        EXPECT_EQ(sorted.items, expected);
        ASSERT_EQ(sorted.starts.size(), parts + 1);
        for (std::uint32_t p = 0; p < parts; ++p)
          ASSERT_EQ(sorted.starts[p + 1] - sorted.starts[p], std::ranges::count(part, p)) << p;
      }
    }
  }
}

}  // namespace
}  // namespace coastmesh
