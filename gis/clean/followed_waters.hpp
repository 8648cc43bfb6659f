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

// The number of waters, their area, and the largest of them.
struct NotedWaters {
  static constexpr std::size_t kMost = 20;

  std::size_t count = 0;
  double area_m2 = 0.0;
  std::vector<NotedWater> largest{};  // largest first, equal ones in the order added

  void add(NotedWater&& water) {
    ++count;
    area_m2 += water.area_m2;
    insert(std::move(water));
  }
  void append(NotedWaters&& more) {
    count += more.count;
    area_m2 += more.area_m2;
    for (NotedWater& water : more.largest) insert(std::move(water));
  }

 private:
  void insert(NotedWater&& water) {
    const auto isLarger = [](const NotedWater& a, const NotedWater& b) { return a.area_m2 > b.area_m2; };
    largest.insert(std::ranges::upper_bound(largest, water, isLarger), std::move(water));
    if (largest.size() > kMost) largest.pop_back();
  }
};

// The changes of the water by following sizes, or of the land if that is meshed, in one group of features or several.
struct FollowedWaters {
  double area_m2 = 0.0;         // of all water, kept or not
  NotedWaters cut_off, apart;   // disconnected: not kept, and kept beside the largest
  NotedWaters joined;           // by widened straits
  std::size_t with_apart = 0;   // groups that keep parts beside the largest
  double closed_m2 = 0.0;       // of `apart`, if connected in the data
  bool cut_off_by_way = false;  // some of `cut_off` is connected in the data
  bool none_kept_open = false;  // the largest was kept although others are at an open boundary
  bool in_plane = false;        // lengths have no unit

  void append(FollowedWaters&& more) {
    area_m2 += more.area_m2;
    cut_off.append(std::move(more.cut_off));
    apart.append(std::move(more.apart));
    joined.append(std::move(more.joined));
    with_apart += more.with_apart;
    closed_m2 += more.closed_m2;
    cut_off_by_way |= more.cut_off_by_way;
    none_kept_open |= more.none_kept_open;
    in_plane |= more.in_plane;
  }
};

}  // namespace coastmesh
