#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/ids.hpp"
#include "core/item_loop.hpp"

namespace coastmesh {

// Resizes a list that grows in several steps to `count` items. All threads touch the memory of new items first, and
// none that of spare room.
template <typename Item>
void resizeOn(const ItemLoop& loop, std::vector<Item>& items, std::size_t count, const Item& fill = {}) {
  if (count > items.capacity()) items.reserve(2 * count);
  constexpr std::size_t kPage = 4096;
  volatile char* const memory = static_cast<char*>(static_cast<void*>(items.data() + items.size()));
  const auto touch = [&](std::size_t first, std::size_t last) {
    for (std::size_t page = first; page < last; ++page) memory[page * kPage] = 0;
  };
  if (count > items.size()) forStretches(loop, (count - items.size()) * sizeof(Item) / kPage, touch, 64);
  items.resize(count, fill);
}

// A list of `count` equal items.
template <typename Item>
BulkList<Item> filledList(const ItemLoop& loop, std::size_t count, const Item& value) {
  BulkList<Item> items = unsetList<Item>(count);
  forEachByStretches(loop, count, [&](std::size_t i) { items[i] = value; });
  return items;
}

// Numbers that are all kNone.
inline BulkList<std::uint32_t> noNumbers(const ItemLoop& loop, std::size_t count) {
  return filledList<std::uint32_t>(loop, count, kNone);
}

// How many items equal a value.
template <typename Items, typename Item>
std::size_t countOn(const ItemLoop& loop, const Items& items, const Item& value) {
  std::size_t all = 0;
  for (const std::size_t some : overStretches(loop, items.size(), [&](std::size_t first, std::size_t last) {
         std::size_t count = 0;
         for (std::size_t i = first; i < last; ++i) count += items[i] == value ? 1 : 0;
         return count;
       }))
    all += some;
  return all;
}

// Replaces each number by the sum of those up to it.
template <typename Numbers>
void sumUpOn(const ItemLoop& loop, Numbers& numbers) {
  using Number = typename Numbers::value_type;
  std::vector<Number> sums = overStretches(loop, numbers.size(), [&](std::size_t first, std::size_t last) {
    Number sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += numbers[i];
    return sum;
  });
  std::exclusive_scan(sums.begin(), sums.end(), sums.begin(), Number{0});
  forEachStretch(loop, numbers.size(), sums.size(), [&](std::size_t s, std::size_t first, std::size_t last) {
    Number sum = sums[s];
    for (std::size_t i = first; i < last; ++i) numbers[i] = sum += numbers[i];
  });
}

// What `add(i, list)` appends for every i below `count`, in this order; several threads fill lists of their own first.
template <typename Item, typename Add>
std::vector<Item> listOver(const ItemLoop& loop, std::size_t count, const Add& add) {
  return joined(overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    std::vector<Item> here;
    for (std::size_t i = first; i < last; ++i) add(i, here);
    return here;
  }));
}

// The numbers from `first` to below `end` for which `is(number)` is true.
template <typename Is>
std::vector<std::uint32_t> numbersWith(const ItemLoop& loop, std::size_t first, std::size_t end, const Is& is) {
  return listOver<std::uint32_t>(loop, end - first, [&](std::size_t i, std::vector<std::uint32_t>& list) {
    const auto number = static_cast<std::uint32_t>(first + i);
    if (is(number)) list.push_back(number);
  });
}

// Lowers a value that other threads may lower at the same time, so that the smallest remains. False if it was not
// larger.
template <typename Value>
bool lowerTo(Value& value, Value to) {
  Value held;
  __atomic_load(&value, &held, __ATOMIC_RELAXED);
  while (to < held)
    if (__atomic_compare_exchange(&value, &held, &to, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) return true;
  return false;
}

}  // namespace coastmesh
