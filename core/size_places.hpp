#pragma once

#include <cstdint>
#include <vector>

#include "core/ids.hpp"

namespace coastmesh {

// Numbers for places of a fine grid, in the order in which they come first: a hash table of numbers alone.
class SizePlaces {
 public:
  struct Place {
    std::uint32_t x = 0, y = 0;
    friend bool operator==(const Place&, const Place&) = default;
  };

  std::uint32_t size() const { return static_cast<std::uint32_t>(places_.size()); }
  const Place& operator[](std::uint32_t number) const { return places_[number]; }
  // kNone where it has none.
  std::uint32_t find(const Place& place) const { return table_.empty() ? kNone : table_[slotOf(place)]; }
  std::uint32_t add(const Place& place) {
    if (2 * places_.size() >= table_.size()) grow();
    std::uint32_t& number = table_[slotOf(place)];
    if (number == kNone) {
      number = size();
      places_.push_back(place);
    }
    return number;
  }

 private:
  // Where it is, or the free slot where it would be.
  std::size_t slotOf(const Place& place) const {
    std::uint64_t hash = (std::uint64_t{place.y} << 32 | place.x) * 0x9E3779B97F4A7C15u;
    hash = (hash ^ (hash >> 32)) * 0xD6E8FEB86659FD93u;
    std::size_t slot = (hash >> 32) & (table_.size() - 1);
    while (table_[slot] != kNone && places_[table_[slot]] != place) slot = (slot + 1) & (table_.size() - 1);
    return slot;
  }
  void grow() {
    constexpr std::size_t kFirst = 64;
    table_.assign(table_.empty() ? kFirst : 2 * table_.size(), kNone);
    for (std::uint32_t i = 0; i < size(); ++i) table_[slotOf(places_[i])] = i;
  }

  std::vector<Place> places_;
  std::vector<std::uint32_t> table_;  // a power of two, at most half full
};

}  // namespace coastmesh
