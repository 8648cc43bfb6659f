#pragma once

#include <vector>

#include "gis/follow/shore_balance.hpp"
#include "gis/follow/shore_ways.hpp"

namespace coastmesh {

struct JoinedShores {
  OpenedShores opened;
  std::vector<WaterWay> ways;  // of each of `opened.waters`, however narrow
  std::vector<JoinedWater> joined;
};

// Opens land and water (`openShores`). Where that would cut off a water whose way to the others is no narrower than
// `options.strait_min`, and to widen it takes little beside the water's area, it is widened instead, as a passage that
// the user names.
JoinedShores openJoined(ShoreStart&& start, const ShoreSizes& sizes, ShoreGuides guides, const FollowOptions& options);

}  // namespace coastmesh
