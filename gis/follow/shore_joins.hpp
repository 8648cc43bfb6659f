#pragma once

#include <vector>

#include "gis/follow/shore_balance.hpp"
#include "gis/follow/shore_straits.hpp"
#include "gis/follow/shore_ways.hpp"

namespace coastmesh {

struct JoinedShores {
  OpenedShores opened;
  std::vector<WaterWay> ways;  // for each of `opened.waters`, of any width
  std::vector<JoinedWater> joined;
  std::vector<ClosedStrait> straits;  // all that were closed
};

// Opens land and water (`openShores`), but not land that, with narrow water beside it, separates large waters. If that
// would cut off a water, its connection is widened like a passage instead, provided that it is at least
// `options.strait_min` wide in the data and widening takes little compared with the water's area. `data`: the shores
// before they were thinned.
JoinedShores openJoined(ShoreStart&& start, const DataShores& data, const ShoreSizes& sizes, ShoreGuides guides,
                        const FollowOptions& options, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
