#include "core/size/size_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <utility>

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
  places.reorder(order);
  ASSERT_EQ(places.size(), order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(places[i], before[order[i]]);
    EXPECT_EQ(places.find(before[order[i]]), i);
  }
  EXPECT_EQ(places.add({1000, 0}), order.size());
}

}  // namespace
}  // namespace coastmesh
