#pragma once

#include <vector>

#include "gis/follow/shore_balance.hpp"
#include "gis/follow/water_gaps.hpp"
#include "gis/projection/scale_table.hpp"

namespace coastmesh {

// Closed water, whose ends remain and are connected some other way.
struct ClosedStrait {
  Point place;            // in its middle
  double length_m = 0.0;  // from end to end
  double width_m = 0.0;   // the least on the widest way, in the data
};

// For each patch of the data's water that was closed, the longest way through it between places of the same water, if
// at least two elements long. REQUIRES: `opened.after` is not settled.
std::vector<ClosedStrait> closedStraits(const WaterGaps& gaps, const OpenedShores& opened, KeepWater keep,
                                        const ScaleTable& scales);

}  // namespace coastmesh
