#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace coastmesh {

// A water that following sizes has changed, for a note. Its share of all water, known only when all groups of features
// are done, goes between the two texts.
struct NotedWater {
  double area_m2 = 0.0;
  std::string before, after;
};

// Inserts an item in descending order, after equal ones; keeps at most `most`.
template <typename Item>
void insertBySize(std::vector<Item>& items, Item&& item, double Item::*size, std::size_t most) {
  const auto isLarger = [size](const Item& a, const Item& b) { return a.*size > b.*size; };
  items.insert(std::ranges::upper_bound(items, item, isLarger), std::move(item));
  if (items.size() > most) items.pop_back();
}

// The number of waters, their area, and the largest of them.
struct NotedWaters {
  static constexpr std::size_t kMost = 20;

  std::size_t count = 0;
  double area_m2 = 0.0;
  std::vector<NotedWater> largest{};  // largest first, equal ones in the order added

  // `waters`: as many as are noted as one.
  void add(NotedWater&& water, std::size_t waters = 1) {
    count += waters;
    area_m2 += water.area_m2;
    insertBySize(largest, std::move(water), &NotedWater::area_m2, kMost);
  }
  void append(NotedWaters&& more) {
    count += more.count;
    area_m2 += more.area_m2;
    for (NotedWater& water : more.largest) insertBySize(largest, std::move(water), &NotedWater::area_m2, kMost);
  }
};

// Something long that following sizes has changed, with its place for a note.
struct NotedLength {
  double length_m = 0.0;
  std::string text;
};

// Their number, and the longest of them.
struct NotedLengths {
  static constexpr std::size_t kMost = 10;

  std::size_t count = 0;
  std::vector<NotedLength> longest{};  // longest first, equal ones in the order added

  void add(NotedLength&& item) {
    ++count;
    insertBySize(longest, std::move(item), &NotedLength::length_m, kMost);
  }
  void append(NotedLengths&& more) {
    count += more.count;
    for (NotedLength& item : more.longest) insertBySize(longest, std::move(item), &NotedLength::length_m, kMost);
  }
};

// The changes of the water by following sizes, or of the land if that is meshed, in one group of features or several.
struct FollowedWaters {
  double area_m2 = 0.0;         // of all water, kept or not
  NotedWaters cut_off, apart;   // disconnected: not kept, and kept beside the largest
  NotedWaters joined;           // by widened straits
  NotedWaters too_small;        // for an element: they stay as they are
  NotedWaters islands;          // larger than some elements, that are gone
  NotedLengths straits, spits;  // closed, and land removed
  NotedLengths met;             // points and ends of lines that the shore was led through, by their distance from it
  std::size_t with_apart = 0;   // groups that keep parts beside the largest
  double closed_m2 = 0.0;       // of `apart`, if connected in the data
  bool cut_off_by_way = false;  // some of `cut_off` is connected in the data
  bool cut_off_widens = false, apart_widens = false;  // and so that a smaller --strait-min would join some
  bool none_kept_open = false;                        // the largest was kept although others are at an open boundary
  bool in_plane = false;                              // lengths have no unit

  void append(FollowedWaters&& more) {
    area_m2 += more.area_m2;
    cut_off.append(std::move(more.cut_off));
    apart.append(std::move(more.apart));
    joined.append(std::move(more.joined));
    too_small.append(std::move(more.too_small));
    islands.append(std::move(more.islands));
    straits.append(std::move(more.straits));
    spits.append(std::move(more.spits));
    met.append(std::move(more.met));
    with_apart += more.with_apart;
    closed_m2 += more.closed_m2;
    cut_off_by_way |= more.cut_off_by_way;
    cut_off_widens |= more.cut_off_widens;
    apart_widens |= more.apart_widens;
    none_kept_open |= more.none_kept_open;
    in_plane |= more.in_plane;
  }
};

}  // namespace coastmesh
