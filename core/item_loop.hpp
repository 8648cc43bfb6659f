#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace coastmesh {

// Calls `work(i)` for every i below `count`, in any order, possibly in parallel on the caller's threads.
using ItemLoop = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

inline void inOrder(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

// Calls `work(i)` for every i below `count` by the loop; a single item without it, since beginning takes longer than
// most items of small meshes.
template <typename Work>
void forItems(const ItemLoop& loop, std::size_t count, const Work& work) {
  if (count == 1) {
    work(std::size_t{0});
  } else {
    loop(count, work);
  }
}

// Calls `work(s, first, last)` for range s of `stretches` that cover 0 to `count`: the ranges of `overStretches`, if
// there are as many.
template <typename Work>
void forEachStretch(const ItemLoop& loop, std::size_t count, std::size_t stretches, const Work& work) {
  forItems(loop, stretches, [&](std::size_t s) { work(s, count * s / stretches, count * (s + 1) / stretches); });
}

// Calls `make(first, last)` for ranges that cover 0 to `count`, and returns the results in order. The ranges depend
// only on `count` and on `least`, the smallest useful number of items, so that sums over them are the same for any
// number of threads.
template <typename Make>
auto overStretches(const ItemLoop& loop, std::size_t count, const Make& make, std::size_t least = 8192) {
  constexpr std::size_t kMostStretches = 1024;
  const std::size_t stretches = std::clamp<std::size_t>(count / least, 1, kMostStretches);
  using Made = decltype(make(count, count));
  static_assert(!std::is_same_v<Made, bool>, "elements of a std::vector<bool> cannot be written by several threads");
  std::vector<Made> made(stretches);
  forEachStretch(loop, count, stretches,
                 [&](std::size_t s, std::size_t first, std::size_t last) { made[s] = make(first, last); });
  return made;
}

// `work(first, last)` for the same ranges.
template <typename Work>
void forStretches(const ItemLoop& loop, std::size_t count, const Work& work, std::size_t least = 8192) {
  overStretches(
      loop, count,
      [&](std::size_t first, std::size_t last) {
        work(first, last);
        return char{};
      },
      least);
}

// `work(i)` for every i below `count`, range by range.
template <typename Work>
void forEachByStretches(const ItemLoop& loop, std::size_t count, const Work& work) {
  forStretches(loop, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) work(i);
  });
}

// Reserves memory for `count` items and touches it with all threads: the first write to a page is much more expensive
// than later ones, and a later `resize` would do all of them on one thread. Reserves room for `spare` more items, whose
// memory is not touched and so costs nothing until used.
template <typename Item, typename Allocator>
void reserveOn(const ItemLoop& loop, std::vector<Item, Allocator>& items, std::size_t count, std::size_t spare = 0) {
  if (count <= items.capacity()) return;
  items.reserve(count + spare);
  constexpr std::size_t kPage = 4096;
  volatile char* const memory = static_cast<char*>(static_cast<void*>(items.data()));
  const std::size_t used = items.size() * sizeof(Item), bytes = count * sizeof(Item);
  const auto touch = [&](std::size_t first, std::size_t last) {
    for (std::size_t page = first; page < last; ++page) memory[used + page * kPage] = 0;
  };
  forStretches(loop, (bytes - used) / kPage, touch, 64);
}

// Frees the memory of a list, which `items = {}` would keep.
template <typename Item, typename Allocator>
void freeMemoryOf(std::vector<Item, Allocator>& items) {
  items = std::vector<Item, Allocator>();
}

// Resizes a list to `count` items that will all be overwritten, with some spare room.
template <typename Item>
void resizeAnew(const ItemLoop& loop, std::vector<Item>& items, std::size_t count) {
  if (count > items.capacity()) {
    freeMemoryOf(items);
    reserveOn(loop, items, count + count / 8);
  }
  items.resize(count);
}

// Concatenates the lists of several ranges.
template <typename Item>
std::vector<Item> joined(std::vector<std::vector<Item>>&& lists) {
  if (lists.size() == 1) return std::move(lists.front());
  std::vector<Item> all;
  for (const std::vector<Item>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

// Sorts items, of which equal ones must be identical: ranges of them first, then merges those in pairs.
template <typename Item>
void sortOn(const ItemLoop& loop, std::vector<Item>& items) {
  constexpr std::size_t kRanges = 64, kWorthRanges = 1 << 15;
  const std::size_t ranges = items.size() < kWorthRanges ? 1 : kRanges;
  const auto at = [&](std::size_t range) {
    return items.begin() + static_cast<std::ptrdiff_t>(items.size() * range / ranges);
  };
  loop(ranges, [&](std::size_t r) { std::sort(at(r), at(r + 1)); });
  for (std::size_t merged = 1; merged < ranges; merged *= 2)
    loop(ranges / (2 * merged), [&](std::size_t r) {
      std::inplace_merge(at(2 * merged * r), at(2 * merged * r + merged), at(2 * merged * (r + 1)));
    });
}

}  // namespace coastmesh
