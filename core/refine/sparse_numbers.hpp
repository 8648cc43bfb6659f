#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/ids.hpp"

namespace coastmesh {

// Numbers of some triangles or vertices out of many. Where ids are as dense as in a patch of a mesh this is several
// times as fast as std::unordered_map, which allocates each entry by itself.
class SparseNumbers {
 public:
  explicit SparseNumbers(std::size_t expected = 0) : entries_(std::bit_ceil(2 * expected + kLeast)) {}

  // kNone where there is none.
  std::uint32_t at(std::uint32_t id) const { return entries_[placeOf(id)].number; }

  // The number of an id, kNone at first; valid until the next call.
  std::uint32_t& operator[](std::uint32_t id) {
    if (2 * used_ >= entries_.size()) grow();
    Entry& entry = entries_[placeOf(id)];
    if (entry.id == kNone) {
      entry.id = id;
      ++used_;
    }
    return entry.number;
  }

 private:
  static constexpr std::size_t kLeast = 16;
  struct Entry {
    std::uint32_t id = kNone, number = kNone;
  };

  std::size_t placeOf(std::uint32_t id) const {
    const std::size_t mask = entries_.size() - 1;
    std::size_t place = (id * 0x9E3779B97F4A7C15ull >> 32) & mask;
    while (entries_[place].id != id && entries_[place].id != kNone) place = (place + 1) & mask;
    return place;
  }
  void grow() {
    const std::vector<Entry> before = std::exchange(entries_, std::vector<Entry>(2 * entries_.size()));
    for (const Entry& entry : before)
      if (entry.id != kNone) entries_[placeOf(entry.id)] = entry;
  }

  std::vector<Entry> entries_;
  std::size_t used_ = 0;
};

}  // namespace coastmesh
