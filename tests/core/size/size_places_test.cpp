#include "core/size/size_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

void expectNumbersOfFirstCome(const std::vector<SizePlaces::Place>& order) {
  SizePlaces places;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
  for (const SizePlaces::Place& place : order) {
    const auto [entry, fresh] = known.try_emplace({place.x, place.y}, static_cast<std::uint32_t>(known.size()));
    EXPECT_EQ(places.find(place), fresh ? kNone : entry->second);
    ASSERT_EQ(places.add(place), entry->second);
    ASSERT_EQ(places[entry->second], place);
  }
  EXPECT_EQ(places.size(), known.size());
}

TEST(SizePlaces, NumbersPlacesAsTheyCome) {
  std::mt19937_64 random(1);
  std::vector<SizePlaces::Place> order;
  for (int i = 0; i < 20000; ++i) {
    const int level = static_cast<int>(random() % 20);
    order.push_back(
        {static_cast<std::uint32_t>(random() % 64) << level, static_cast<std::uint32_t>(random() % 64) << level});
  }
  expectNumbersOfFirstCome(order);
}

// These places share few rows of the hash table.
TEST(SizePlaces, NumbersPlacesThatStandInTheWayOfEachOther) {
  std::vector<SizePlaces::Place> order;
  for (std::uint32_t i = 0; i < 5000; ++i) order.push_back({8 * i + 1, 0});
  for (std::uint32_t i = 0; i < 5000; ++i) order.push_back({1, 8 * i});
  for (std::uint32_t i = 0; i < 5000; ++i) order.push_back({8 * i + 1, 0});
  expectNumbersOfFirstCome(order);
}

// In whatever order its ranges are processed. There are several, the table grows in between, and some points are there
// already or have numbers.
TEST(SizePlaces, NumbersManyAtOnceAsOneByOne) {
  std::mt19937_64 random(3);
  std::vector<SizePlaces::Place> order;
  for (int i = 0; i < 100'000; ++i) {
    const int level = static_cast<int>(random() % 6);
    order.push_back(
        {static_cast<std::uint32_t>(random() % 256) << level, static_cast<std::uint32_t>(random() % 256) << level});
  }
  SizePlaces one_by_one;
  std::vector<std::uint32_t> expected;
  for (const SizePlaces::Place& place : order) expected.push_back(one_by_one.add(place));
  for (const ItemLoop& loop : {ItemLoop(inOrder), ItemLoop(testing::backwards)}) {
    constexpr std::size_t kBefore = 1000;
    SizePlaces places;
    for (std::size_t i = 0; i < kBefore; ++i) places.add(order[i]);
    std::vector<std::uint32_t> numbers(order.size(), kNone);
    for (std::size_t i = 0; i < kBefore; i += 3) numbers[i] = expected[i];
    places.addAll(
        loop, [&](std::size_t i) { return order[i]; }, numbers);
    EXPECT_EQ(numbers, expected);
    ASSERT_EQ(places.size(), one_by_one.size());
    for (std::uint32_t v = 0; v < places.size(); ++v) ASSERT_EQ(places[v], one_by_one[v]);
    for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(places.find(order[i]), expected[i]);
  }
}

TEST(SizePlaces, HasNoneAtFirst) { EXPECT_EQ(SizePlaces().find({0, 0}), kNone); }

TEST(SizePlaces, AreFoundByTheNumbersOfAnotherOrder) {
  SizePlaces places;
  std::vector<SizePlaces::Place> before;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    before.push_back({i % 37, 5 * i});
    places.add(before.back());
  }
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(order, std::mt19937_64(2));
  std::vector<std::uint32_t> numbers(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) numbers[order[i]] = i;
  places.reorder(inOrder, order, numbers);
  ASSERT_EQ(places.size(), order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(places[i], before[order[i]]);
    EXPECT_EQ(places.find(before[order[i]]), i);
  }
  EXPECT_EQ(places.add({1000, 0}), order.size());
}

}  // namespace
}  // namespace coastmesh
