#pragma once

#include <vector>

#include "gis/follow/shore_balance.hpp"
#include "gis/follow/shore_ways.hpp"

namespace coastmesh {

// A water that closing would have cut off, and the way that was made wide instead.
struct JoinedWater {
  WaterWay way;
  double area = 0.0;  // square metres
};

struct JoinedShores {
  OpenedShores opened;
  std::vector<WaterWay> ways;  // of each of `opened.waters`, however narrow
  std::vector<JoinedWater> joined;
};

// Opens land and water (`openShores`). Where that would cut off a water whose way to the others is no narrower than
// `options.strait_min`, and to widen it takes little beside the water's area, it is widened instead, as a passage that
// the user names.
JoinedShores openJoined(ShoreGraph graph, const ShoreSizes& sizes, ShoreGuides guides, const FollowOptions& options,
                        const ShoreEdit& edit);

}  // namespace coastmesh
