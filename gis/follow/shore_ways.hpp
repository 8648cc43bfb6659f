#pragma once

#include <vector>

#include "gis/follow/shore_balance.hpp"

namespace coastmesh {

// How a water that closing cuts off is joined to one that stays: the way that is widest for its length.
struct WaterWay {
  bool exists = false;            // else nothing joins them in the data
  std::vector<ShoreLine> narrow;  // along what of it is narrower than the narrowest that stays
  double least = 0.0;             // the narrowest, as a multiple of the size wanted there
  Point place;                    // where
  double width_m = 0.0;           // there
  double length_m = 0.0;          // of what is narrow
  double widening_m2 = 0.0;       // of land that goes where that is made wide enough
};

// Which are the largest of those that are kept of their region.
std::vector<bool> areMain(const std::vector<WaterPart>& waters);

// One for each of the waters that opening has made: of those that are kept to the largest of them, which has none, of
// the others to any that is kept.
std::vector<WaterWay> waysToWaters(const OpenedShores& opened, const ShoreSizes& sizes, const FollowOptions& options);

// A water that closing cuts off, or parts from the largest, and the way that is to be made wide instead.
struct JoinedWater {
  WaterWay way;
  double area = 0.0;  // square metres
};

// Those whose ways (see waysToWaters) are nowhere narrower than `options.strait_min` times the size wanted, and take
// little to be widened beside the water's area; also ways to others that are joined so.
std::vector<JoinedWater> waysToJoin(const OpenedShores& opened, const ShoreSizes& sizes, const FollowOptions& options);

}  // namespace coastmesh
