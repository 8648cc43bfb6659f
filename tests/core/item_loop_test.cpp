#include "core/item_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "core/bulk_list.hpp"
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

TEST(BulkList, LeavesUnsetItemsAsTheirMemoryIs) {
  BulkList<std::uint32_t> list(1000, 7u);
  list.resize(10);
  resizeUnset(list, 1000);
  EXPECT_EQ(list, BulkList<std::uint32_t>(1000, 7u)) << "nothing was written";
  resizeUnset(list, 3);
  EXPECT_EQ(list, BulkList<std::uint32_t>(3, 7u));
  list.resize(5);
  EXPECT_EQ(list, (BulkList<std::uint32_t>{7, 7, 7, 0, 0})) << "resize sets values as ever";
  list.emplace_back();
  EXPECT_EQ(list.back(), 0u);
}

TEST(BulkList, KeepsItsItemsWhereverItMoves) {
  for (const ItemLoop& loop : {ItemLoop(inOrder), ItemLoop(testing::backwards)}) {
    BulkList<std::uint64_t> list;
    for (std::uint64_t i = 0; i < 20000; ++i) list.push_back(i);
    const BulkList<std::uint64_t> before = list;
    growOn(loop, list, 50000, 100);
    EXPECT_GE(list.capacity(), 50100u);
    EXPECT_EQ(list, before);
    EXPECT_EQ(copyOn(loop, list), before);
    resizeUnset(list, 90000);
    ASSERT_EQ(list.size(), 90000u);
    list.resize(20000);
    EXPECT_EQ(list, before);
    resizeAnew(loop, list, 200000);
    EXPECT_EQ(list.size(), 200000u);
  }
}

}  // namespace
}  // namespace coastmesh
