#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gis/clean/clean_report.hpp"
#include "gis/clean/domain.hpp"
#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_joins.hpp"
#include "gis/follow/water_lines.hpp"
#include "gis/projection/projection.hpp"
#include "gis/shore/lost_islands.hpp"

namespace coastmesh {

struct DetachedWater {
  WaterPart water;
  WaterWay way;  // to the others, in the data
};

// A water in which no element fits, which stays as it is.
struct SmallWater {
  double area = 0.0;  // square metres
  Point place;
};

// Notes for users on a shore that was made to follow sizes.
struct FollowNotes {
  double area = 0.0;                   // square metres of water, including what is cut off
  std::vector<DetachedWater> cut_off;  // not kept, but meshed nevertheless if all are
  std::vector<DetachedWater> apart;    // kept beside the largest
  std::vector<JoinedWater> joined;
  std::vector<SmallWater> too_small;
  std::vector<ClosedStrait> straits;
  std::vector<DroppedSpit> spits;
  PassageEffects passages;
  std::vector<OpenBarrier> open_barriers;
};

// Adds warnings on weirs, constraints and points that have no water left.
void noteLostLines(const LostLines& lost, const Domain& domain, CleanReport& report);

// A point or an end of a line in the water, almost on the shore, that the shore was led through.
NotedLength metPoint(const Point& place, double apart_m, const Projection& projection);

// Segments of boundaries that following left much shorter than the size.
struct ShortSegments {
  std::size_t count = 0;
  Point place;  // of the shortest, as a share of the size
  double length_m = 0.0, size_m = 0.0;
};

std::string warningOf(const ShortSegments& segments, const Projection& projection);

// Notes the islands, of those before, that are gone from the domain's water.
void noteLostIslands(const std::vector<IslandRing>& before, const Domain& domain, const SizeFunction& size,
                     FollowedWaters& waters, const ItemLoop& loop = inOrder);

// Adds sentences on guides to the report, and the largest changes of the water, with their places in the input's CRS.
// Sentences on these are left to `noteWaters`, as they are for all groups of features.
void noteFollowing(FollowNotes&& notes, const ShoreGuides& guides, const FollowOptions& options,
                   const Projection& projection, CleanReport& report);

}  // namespace coastmesh
