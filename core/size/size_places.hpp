#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/ids.hpp"

namespace coastmesh {

// Consecutive numbers for points of a fine grid, in order of first use: a hash table of numbers only.
class SizePlaces {
 public:
  struct Place {
    std::uint32_t x = 0, y = 0;
    friend bool operator==(const Place&, const Place&) = default;
  };

  std::uint32_t size() const { return static_cast<std::uint32_t>(places_.size()); }
  const Place& operator[](std::uint32_t number) const { return places_[number]; }
  // kNone if the point has no number.
  std::uint32_t find(const Place& place) const { return table_.empty() ? kNone : table_[slotOf(place)]; }
  std::uint32_t add(const Place& place) {
    if (8 * places_.size() >= 3 * table_.size()) grow();
    std::uint32_t& number = table_[slotOf(place)];
    if (number == kNone) {
      number = size();
      places_.push_back(place);
    }
    return number;
  }
  // Prefetch what adding a point needs: first its slot, some time later the entry of its number.
  [[gnu::always_inline]] void fetchSlot(const Place& place) const {
    if (!table_.empty()) __builtin_prefetch(&table_[firstSlotOf(place) & (table_.size() - 1)]);
  }
  [[gnu::always_inline]] void fetchPlace(const Place& place) const {
    if (table_.empty()) return;
    const std::uint32_t number = table_[firstSlotOf(place) & (table_.size() - 1)];
    if (number != kNone) __builtin_prefetch(&places_[number]);
  }
  // Renumbers all points: `order` lists the old numbers, each once, in the order of the new ones.
  void reorder(const std::vector<std::uint32_t>& order) {
    std::vector<Place> places;
    places.reserve(order.size() + order.size() / 32);
    places.resize(order.size());
    std::vector<std::uint32_t> numbers(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      places[i] = places_[order[i]];
      numbers[order[i]] = i;
    }
    places_ = std::move(places);
    for (std::uint32_t& number : table_)
      if (number != kNone) number = numbers[number];
  }

 private:
  static constexpr std::size_t kBlock = 64;

  // Start and step of the search for a point. A block of 8 by 8 points of one level has consecutive slots.
  static std::uint64_t firstSlotOf(const Place& place, std::uint64_t* step = nullptr) {
    constexpr int kMostShift = 31;
    const int level = std::min(std::countr_zero(place.x | place.y), kMostShift);
    const std::uint64_t x = place.x >> level, y = place.y >> level;
    std::uint64_t hash = ((y >> 3) << 32 | (x >> 3)) * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(level);
    hash = (hash ^ (hash >> 32)) * 0xD6E8FEB86659FD93u;
    // An odd step visits every slot.
    if (step) *step = (hash >> 40) * kBlock + 1;
    return (hash >> 20) * kBlock + (y & 7) * 8 + (x & 7);
  }
  // The slot of a point, or the free slot for it.
  std::size_t slotOf(const Place& place) const {
    std::uint64_t step;
    const std::uint64_t last = table_.size() - 1;
    std::uint64_t slot = firstSlotOf(place, &step) & last;
    while (table_[slot] != kNone && places_[table_[slot]] != place) slot = (slot + step) & last;
    return slot;
  }
  void grow() {
    table_.assign(table_.empty() ? 4 * kBlock : 2 * table_.size(), kNone);
    for (std::uint32_t i = 0; i < size(); ++i) table_[slotOf(places_[i])] = i;
  }

  std::vector<Place> places_;
  std::vector<std::uint32_t> table_;  // a power of two, at most three eighths full
};

}  // namespace coastmesh
