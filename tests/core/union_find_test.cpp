#include "core/union_find.hpp"

#include <gtest/gtest.h>

#include <random>
#include <thread>

namespace coastmesh {
namespace {

TEST(SharedUnionFind, ThreadsMakeTheSetsOfOne) {
  constexpr std::uint32_t kMembers = 50000, kPairs = 45000, kThreads = 4;
  std::mt19937 random(4);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < kPairs; ++i) pairs.emplace_back(random() % kMembers, random() % kMembers);
  UnionFind expected(kMembers);
  for (const auto& [a, b] : pairs) expected.unite(a, b);
  SharedUnionFind shared(kMembers, inOrder);
  std::vector<std::thread> threads;
  for (std::uint32_t t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      for (std::uint32_t i = t; i < kPairs; i += kThreads) shared.unite(pairs[i].first, pairs[i].second);
    });
  for (std::thread& thread : threads) thread.join();
  std::uint32_t roots = 0;
  for (std::uint32_t i = 0; i < kMembers; ++i) {
    ASSERT_EQ(shared.find(i), expected.find(i));
    roots += shared.find(i) == i ? 1 : 0;
  }
  EXPECT_GT(roots, 1u);
}

}  // namespace
}  // namespace coastmesh
