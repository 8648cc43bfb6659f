#pragma once

#include <vector>

#include "gis/follow/shore_balance.hpp"

namespace coastmesh {

// The connection of a water that closing cuts off with one that stays: the widest for its length.
struct WaterWay {
  bool exists = false;            // false: nothing connects them in the data
  std::vector<ShoreLine> narrow;  // along parts narrower than the narrowest that stays
  double least = 0.0;             // the least width, as a multiple of the size wanted there
  Point place;                    // of the least width
  double width_m = 0.0;           // there
  double length_m = 0.0;          // of narrow parts
  double widening_m2 = 0.0;       // of land removed by widening these
};

// For each water: true if it is the largest kept part of its whole.
std::vector<bool> areMain(const std::vector<WaterPart>& waters);

// A way for each water made by opening: from kept ones to the largest of them, which has none; from others to any kept
// one.
std::vector<WaterWay> waysToWaters(const OpenedShores& opened, const ShoreSizes& sizes, const FollowOptions& options);

// A water that closing cuts off, or separates from the largest, and the way to widen instead.
struct JoinedWater {
  WaterWay way;
  double area = 0.0;          // square metres
  std::vector<Point> inside;  // as in `WaterPart`
  bool was_kept = false;      // separated from the largest, but not cut off
};

// Waters whose ways (see `waysToWaters`) are at least `options.strait_min` sizes wide, and take little area to widen
// compared with the water; also by ways to others joined like this.
std::vector<JoinedWater> waysToJoin(const OpenedShores& opened, const ShoreSizes& sizes, const FollowOptions& options);

}  // namespace coastmesh
