#include "apps/job/deal_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace coastmesh {
namespace {

std::vector<std::size_t> loadsOf(const std::vector<std::size_t>& points, const std::vector<std::uint32_t>& shard_of,
                                 std::uint32_t shards) {
  std::vector<std::size_t> loads(shards, 0);
  for (std::size_t group = 0; group < points.size(); ++group) loads.at(shard_of.at(group)) += points[group];
  return loads;
}

// Sizes are distributed like those of the world's lakes: many small ones, few large ones.
TEST(DealGroups, SharesAreOfLikeWork) {
  std::mt19937_64 random(7);
  std::vector<std::size_t> points;
  for (int i = 0; i < 50000; ++i)
    points.push_back(
        static_cast<std::size_t>(4.0 / std::pow(1e-4 + std::uniform_real_distribution<double>()(random), 0.8)));
  for (const std::uint32_t shards : {2u, 7u, 64u}) {
    const std::vector<std::uint32_t> shard_of = dealGroups(points, shards);
    ASSERT_EQ(shard_of.size(), points.size());
    const std::vector<std::size_t> loads = loadsOf(points, shard_of, shards);
    EXPECT_LE(std::ranges::max(loads), 1.05 * static_cast<double>(std::ranges::min(loads))) << shards;
  }
}

// A single large group gets a shard of its own if the small ones fit into the others.
TEST(DealGroups, ALargeGroupGoesAlone) {
  std::vector<std::size_t> points(300, 100);
  points[123] = 1'000'000;
  const std::vector<std::uint32_t> shard_of = dealGroups(points, 4);
  for (std::size_t group = 0; group < points.size(); ++group)
    EXPECT_EQ(shard_of[group] == shard_of[123], group == 123) << group;
  const std::vector<std::size_t> loads = loadsOf(points, shard_of, 4);
  EXPECT_EQ(std::ranges::min(loads), 9900u);
}

TEST(DealGroups, MoreShardsThanGroups) {
  const std::vector<std::uint32_t> shard_of = dealGroups({5, 5, 5}, 10);
  EXPECT_EQ(shard_of, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(dealGroups({}, 3).empty());
}

}  // namespace
}  // namespace coastmesh
