#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// Stands for an item that is not set: what a BulkList constructs from it has no value until it is written.
struct UnsetItem {
  template <typename Item>
  operator Item() const {
    return {};
  }
};

// Constructs all items as usual except unset ones, whose memory it leaves as it is.
template <typename Item>
struct BulkAllocator : std::allocator<Item> {
  // Of items that begin to live where there is memory for them.
  static constexpr bool kMayBeUnset = std::is_trivially_copyable_v<Item> && std::is_trivially_destructible_v<Item>;

  BulkAllocator() = default;
  template <typename Other>
  BulkAllocator(const BulkAllocator<Other>&) {}

  template <typename Made, typename... From>
  void construct(Made* at, From&&... from) {
    std::construct_at(at, std::forward<From>(from)...);
  }
  template <typename Made>
  void construct(Made*, UnsetItem&&) {
    static_assert(kMayBeUnset);
  }
};

// A std::vector for arrays of up to gigabytes: `resizeUnset` appends items without a pass over them on one thread.
template <typename Item>
using BulkList = std::vector<Item, BulkAllocator<Item>>;

// A place in a row of unset items.
struct UnsetItems {
  using iterator_category = std::random_access_iterator_tag;
  using value_type = UnsetItem;
  using difference_type = std::ptrdiff_t;
  using pointer = const UnsetItem*;
  using reference = UnsetItem;

  std::size_t place = 0;

  UnsetItem operator*() const { return {}; }
  UnsetItems& operator++() {
    ++place;
    return *this;
  }
  UnsetItems& operator--() {
    --place;
    return *this;
  }
  UnsetItems& operator+=(std::ptrdiff_t by) {
    place += static_cast<std::size_t>(by);
    return *this;
  }
  friend std::ptrdiff_t operator-(const UnsetItems& a, const UnsetItems& b) {
    return static_cast<std::ptrdiff_t>(a.place - b.place);
  }
  friend bool operator==(const UnsetItems&, const UnsetItems&) = default;
};

// Resizes to `count` items. New ones have no value: all must be written before any is read, by whatever threads.
template <typename Item>
void resizeUnset(BulkList<Item>& items, std::size_t count) {
  if (count <= items.size()) {
    items.resize(count);
  } else {
    items.insert(items.end(), UnsetItems{0}, UnsetItems{count - items.size()});
  }
}

// A list of `count` items without values, as above.
template <typename Item>
BulkList<Item> unsetList(std::size_t count) {
  BulkList<Item> items;
  resizeUnset(items, count);
  return items;
}

// Resizes a list to `count` items that will all be overwritten, with some spare room.
template <typename Item>
void resizeAnew(const ItemLoop&, BulkList<Item>& items, std::size_t count) {
  if (count > items.capacity()) {
    freeMemoryOf(items);
    items.reserve(count + count / 8);
  }
  resizeUnset(items, count);
}

// A copy that all threads make.
template <typename Item>
BulkList<Item> copyOn(const ItemLoop& loop, const BulkList<Item>& items) {
  BulkList<Item> copy;
  resizeUnset(copy, items.size());
  forEachByStretches(loop, items.size(), [&](std::size_t i) { copy[i] = items[i]; });
  return copy;
}

// Makes room for `count` items, and for `spare` more whose memory is not touched. If the list has to move, all threads
// touch the new memory first; `reserve` would touch it on one thread, while copying.
template <typename Item>
void growOn(const ItemLoop& loop, std::vector<Item>& items, std::size_t count, std::size_t spare = 0) {
  if (count <= items.capacity()) return;
  std::vector<Item> grown;
  reserveOn(loop, grown, count, spare);
  grown.insert(grown.end(), items.begin(), items.end());
  items = std::move(grown);
}

// The same; all threads copy the items.
template <typename Item>
void growOn(const ItemLoop& loop, BulkList<Item>& items, std::size_t count, std::size_t spare = 0) {
  if (count <= items.capacity()) return;
  BulkList<Item> grown;
  grown.reserve(count + spare);
  resizeUnset(grown, items.size());
  forEachByStretches(loop, items.size(), [&](std::size_t i) { grown[i] = items[i]; });
  items = std::move(grown);
}

}  // namespace coastmesh
