#include "core/refine/sparse_numbers.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace coastmesh {
namespace {

TEST(SparseNumbers, HoldsWhatAMapHolds) {
  std::mt19937 random(7);
  for (const std::uint32_t most : {40u, 3000u, 0xFFFFFFFEu}) {
    SparseNumbers ids;
    std::map<std::uint32_t, std::uint32_t> expected;
    for (std::uint32_t i = 0; i < 5000; ++i) {
      const std::uint32_t id = std::uniform_int_distribution<std::uint32_t>(0, most)(random);
      EXPECT_EQ(ids.at(id), expected.contains(id) ? expected[id] : kNone);
      EXPECT_EQ(ids[id], ids.at(id));
      ids[id] = expected[id] = i;
    }
    for (const auto& [id, number] : expected) EXPECT_EQ(ids.at(id), number);
  }
}

// Ids that differ in high bits alone, or by powers of two, as those of a lattice's rows do.
TEST(SparseNumbers, HoldsIdsOfLikeBits) {
  for (const unsigned shift : {0u, 12u, 20u}) {
    SparseNumbers ids(100);
    for (std::uint32_t i = 0; i < 4096; ++i) ids[i << shift] = i;
    for (std::uint32_t i = 0; i < 4096; ++i) ASSERT_EQ(ids.at(i << shift), i);
  }
}

TEST(SparseNumbers, LeavesAnIdWithoutNumberWhereNoneIsGiven) {
  SparseNumbers ids;
  EXPECT_EQ(ids[5], kNone);
  EXPECT_EQ(ids.at(5), kNone);
  EXPECT_EQ(ids.at(6), kNone);
}

}  // namespace
}  // namespace coastmesh
