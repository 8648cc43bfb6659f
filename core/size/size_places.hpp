#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/large_list.hpp"

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
    if (isFull()) growIfFull(inOrder);
    std::uint32_t& number = table_[slotOf(place)];
    if (number == kNone) {
      number = size();
      places_.push_back(place);
    }
    return number;
  }
  // Numbers many points as `add` would one after the other: where `numbers[i]` is kNone, it becomes the number of
  // `placeOf(i)`, which has to depend on i alone.
  template <typename PlaceOf>
  void addAll(const ItemLoop& loop, const PlaceOf& placeOf, std::span<std::uint32_t> numbers) {
    for (std::size_t first = 0; first < numbers.size();) {
      growIfFull(loop);
      // The table stays a quarter empty even if all of these are new.
      const std::size_t room = table_.size() / 4 * 3 - places_.size();
      const std::size_t count = std::min(room, numbers.size() - first);
      addSome(
          loop, [&](std::size_t i) { return placeOf(first + i); }, numbers.subspan(first, count));
      first += count;
    }
    growIfFull(loop);
  }
  // Renumbers all points: `order` lists the old numbers, each once, in the order of the new ones; `numbers` is its
  // inverse.
  void reorder(const ItemLoop& loop, std::span<const std::uint32_t> order, std::span<const std::uint32_t> numbers) {
    std::vector<Place> places;
    reserveOn(loop, places, order.size(), order.size() / 32);
    places.resize(order.size());
    forEachByStretches(loop, order.size(), [&](std::size_t i) { places[i] = places_[order[i]]; });
    places_ = std::move(places);
    forEachByStretches(loop, table_.size(), [&](std::size_t slot) {
      if (table_[slot] != kNone) table_[slot] = numbers[table_[slot]];
    });
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
  struct Search {
    std::uint64_t slot = 0, step = 0;
  };
  Search searchFor(const Place& place) const {
    Search search;
    search.slot = firstSlotOf(place, &search.step) & (table_.size() - 1);
    return search;
  }
  // For several threads at once: the slot that has `number` afterwards, or a smaller one for which `isSame` is true.
  template <typename IsSame>
  std::size_t claimSlot(Search search, std::uint32_t number, const IsSame& isSame) {
    for (const std::uint64_t last = table_.size() - 1;; search.slot = (search.slot + search.step) & last) {
      std::uint32_t& slot = table_[search.slot];
      std::uint32_t held = __atomic_load_n(&slot, __ATOMIC_RELAXED);
      if (held == kNone && __atomic_compare_exchange_n(&slot, &held, number, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
        return search.slot;
      if (!isSame(held)) continue;
      lowerTo(slot, number);
      return search.slot;
    }
  }
  // Adds points that fit into the table. A new point's slot first holds the smallest index that asks for it, above all
  // numbers: that does not depend on the order of the threads, and becomes a number by counting.
  template <typename PlaceOf>
  void addSome(const ItemLoop& loop, const PlaceOf& placeOf, std::span<std::uint32_t> numbers) {
    const std::uint32_t known = size();
    BulkList<std::uint32_t> slots = unsetList<std::uint32_t>(numbers.size());
    forStretches(loop, numbers.size(), [&](std::size_t first, std::size_t last) {
      // Some at once, so that their slots are fetched from memory at the same time.
      constexpr std::size_t kAtOnce = 32;
      std::array<Place, kAtOnce> places;
      std::array<Search, kAtOnce> searches;
      for (; first < last; first += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, last - first);
        for (std::size_t k = 0; k < count; ++k) {
          if (numbers[first + k] != kNone) continue;
          places[k] = placeOf(first + k);
          searches[k] = searchFor(places[k]);
          __builtin_prefetch(&table_[searches[k].slot], 1);
        }
        for (std::size_t k = 0; k < count; ++k) {
          slots[first + k] = kNone;
          if (numbers[first + k] != kNone) continue;
          const auto isSame = [&](std::uint32_t held) {
            return (held < known ? places_[held] : placeOf(held - known)) == places[k];
          };
          const auto number = known + static_cast<std::uint32_t>(first + k);
          slots[first + k] = static_cast<std::uint32_t>(claimSlot(searches[k], number, isSame));
        }
      }
    });
    const std::vector<std::vector<std::uint32_t>> fresh =
        overStretches(loop, numbers.size(), [&](std::size_t first, std::size_t last) {
          std::vector<std::uint32_t> here;
          for (auto i = static_cast<std::uint32_t>(first); i < last; ++i)
            if (slots[i] != kNone && table_[slots[i]] == known + i) here.push_back(i);
          return here;
        });
    std::vector<std::uint32_t> begin = {known};
    for (const std::vector<std::uint32_t>& here : fresh)
      begin.push_back(begin.back() + static_cast<std::uint32_t>(here.size()));
    resizeOn(loop, places_, begin.back());
    loop(fresh.size(), [&](std::size_t s) {
      std::uint32_t number = begin[s];
      for (const std::uint32_t i : fresh[s]) {
        places_[number] = placeOf(i);
        table_[slots[i]] = number++;
      }
    });
    forEachByStretches(loop, numbers.size(), [&](std::size_t i) {
      if (slots[i] != kNone) numbers[i] = table_[slots[i]];
    });
  }
  bool isFull() const { return 8 * places_.size() >= 3 * table_.size(); }
  void growIfFull(const ItemLoop& loop) {
    while (isFull()) {
      const std::size_t slots = table_.empty() ? 4 * kBlock : 2 * table_.size();
      table_ = {};  // first, so that there are never two
      table_ = noNumbers(loop, slots);
      const auto isSame = [](std::uint32_t) { return false; };
      forStretches(loop, places_.size(), [&](std::size_t first, std::size_t last) {
        constexpr std::size_t kAhead = 16;
        for (std::size_t i = first; i < last; ++i) {
          if (i + kAhead < last) __builtin_prefetch(&table_[searchFor(places_[i + kAhead]).slot], 1);
          claimSlot(searchFor(places_[i]), static_cast<std::uint32_t>(i), isSame);
        }
      });
    }
  }

  std::vector<Place> places_;
  BulkList<std::uint32_t> table_;  // a power of two, at most three eighths full between calls
};

}  // namespace coastmesh
