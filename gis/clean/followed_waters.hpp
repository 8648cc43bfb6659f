#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace coastmesh {

// A water that following sizes has changed, for a note: its share of all water goes between the two texts. That is
// known only when all groups of features are done.
struct NotedWater {
  double area_m2 = 0.0;
  std::string before, after;
};

// How many there are, and the largest of them.
struct NotedWaters {
  static constexpr std::size_t kMost = 20;

  std::size_t count = 0;
  double area_m2 = 0.0;
  std::vector<NotedWater> largest{};  // the largest first, of equals that which came first

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

// What following sizes has made of the water, or of the land where that is meshed; of one group of features, or of
// several.
struct FollowedWaters {
  double area_m2 = 0.0;         // of all of it, before
  NotedWaters cut_off, apart;   // without a connection: what is not kept, and what is kept beside the largest
  NotedWaters joined;           // by straits that were widened
  std::size_t with_apart = 0;   // groups of which parts are kept beside the largest
  double closed_m2 = 0.0;       // of `apart`, where the data have a connection
  bool cut_off_by_way = false;  // the data have one for any of `cut_off`
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
