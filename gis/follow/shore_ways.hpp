#pragma once

#include <vector>

#include "gis/follow/shore_balance.hpp"
#include "gis/follow/water_gaps.hpp"

namespace coastmesh {

// The connection of a water that closing cuts off with one that stays, through water of the data.
struct WaterWay {
  bool exists = false;            // false: nothing connects them in the data
  std::vector<ShoreLine> narrow;  // along parts that were closed
  double least = 0.0;             // the least width in the data there, as a multiple of the size wanted
  Point place;                    // of the least width
  double width_m = 0.0;           // there
  double length_m = 0.0;          // of narrow parts
  double widening_m2 = 0.0;       // of land removed by widening these
  // Edges of the data's triangles: those crossed in narrow parts, and of these, those too narrow for a search.
  std::vector<EdgeRef> crossed, too_narrow;
};

// For each water: true if it is the largest kept part of its whole.
std::vector<bool> areMain(const std::vector<WaterPart>& waters);

// The widest way for each water made by opening: from kept ones to the largest of them, which has none; from others to
// any kept one. REQUIRES, here and below: `opened.after` is not settled.
std::vector<WaterWay> waysToWaters(const WaterGaps& gaps, const OpenedShores& opened, const ShoreSizes& sizes);

// True if widening the way takes little area compared with that of the water behind it, square metres.
bool isWorthWidening(const WaterWay& way, double area);

// A water that closing cuts off, or separates from the largest, and the way to widen instead.
struct JoinedWater {
  WaterWay way;
  double area = 0.0;          // square metres
  std::vector<Point> inside;  // as in `WaterPart`
  bool was_kept = false;      // separated from the largest, but not cut off
};

// Waters with a way that is at least `options.strait_min` sizes wide in the data, the widest for its length, and takes
// little area to widen compared with the water; also by ways to others joined like this.
std::vector<JoinedWater> waysToJoin(const WaterGaps& gaps, const OpenedShores& opened, const ShoreSizes& sizes,
                                    const FollowOptions& options);

}  // namespace coastmesh
