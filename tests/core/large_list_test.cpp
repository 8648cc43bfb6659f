#include "core/large_list.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {

namespace {

// Below and above the length of one range, and with more than the most ranges.
const std::vector<std::size_t> kLengths{0, 1, 8191, 20'000, 9'000'000};

TEST(LargeList, HasTheValueEverywhere) {
  for (const std::size_t length : kLengths) {
    const BulkList<std::uint8_t> list = filledList(testing::backwards, length, std::uint8_t{7});
    EXPECT_EQ(list, BulkList<std::uint8_t>(length, 7)) << length;
  }
}

TEST(LargeList, EqualItemsAreCounted) {
  for (const std::size_t length : kLengths) {
    BulkList<std::uint8_t> list(length, 0);
    for (std::size_t i = 0; i < length; i += 3) list[i] = 1;
    EXPECT_EQ(countOn(testing::backwards, list, std::uint8_t{1}), (length + 2) / 3) << length;
    EXPECT_EQ(countOn(testing::backwards, list, std::uint8_t{2}), 0u) << length;
  }
}

TEST(LargeList, SumsRunOverAllRanges) {
  for (const std::size_t length : kLengths) {
    BulkList<std::uint32_t> list(length);
    for (std::size_t i = 0; i < length; ++i) list[i] = static_cast<std::uint32_t>(i % 5);
    BulkList<std::uint32_t> sums = list;
    std::partial_sum(list.begin(), list.end(), list.begin());
    sumUpOn(testing::backwards, sums);
    EXPECT_EQ(sums, list) << length;
  }
}

}  // namespace

}  // namespace coastmesh
