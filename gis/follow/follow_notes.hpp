#pragma once

#include <cstddef>
#include <vector>

#include "gis/clean/clean_report.hpp"
#include "gis/clean/domain.hpp"
#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_joins.hpp"
#include "gis/follow/water_lines.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

struct DetachedWater {
  WaterPart water;
  WaterWay way;  // to the others, in the data
};

// Notes for users on a shore that was made to follow sizes.
struct FollowNotes {
  double area = 0.0;                   // square metres of water, including what is cut off
  std::vector<DetachedWater> cut_off;  // not kept, but meshed nevertheless if all are
  std::vector<DetachedWater> apart;    // kept beside the largest
  std::vector<JoinedWater> joined;
  std::vector<ClosedStrait> straits;
  std::vector<DroppedSpit> spits;
  PassageEffects passages;
  std::vector<OpenBarrier> open_barriers;
};

// Points and ends of lines in the water, almost on the shore, that it was led through.
struct MetPoints {
  std::size_t count = 0;
  Point farthest;        // from the original shore
  double apart_m = 0.0;  // of `farthest`

  void add(const Point& place, double metres) {
    if (count++ != 0 && metres <= apart_m) return;
    farthest = place;
    apart_m = metres;
  }
};

// Adds a note to the report if there are any.
void noteMetPoints(const MetPoints& met, const Projection& projection, CleanReport& report);

// Adds warnings on weirs, constraints and points that have no water left.
void noteLostLines(const LostLines& lost, const Domain& domain, CleanReport& report);

// Adds sentences on the largest changes to the report, with their places in the input's CRS. Shares of the water are
// left to `noteWaters`, as they refer to all groups of features.
void noteFollowing(FollowNotes&& notes, const ShoreGuides& guides, const FollowOptions& options,
                   const Projection& projection, CleanReport& report);

}  // namespace coastmesh
