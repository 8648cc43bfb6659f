#pragma once

#include <limits>
#include <tuple>
#include <vector>

#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_opening.hpp"

namespace coastmesh {

struct OpenedShores {
  ShoreTriangles before;  // the water as it was first closed, when land that goes first had gone
  ShoreGraph graph;
  std::vector<WaterPart> waters;
  std::vector<ClosedStrait> straits;
  WaterAreas areas, gained;
  std::vector<std::tuple<EditKind, Point, RegionId>> edits;
  double first = 1.0;  // how narrow land went before water, as a share of the narrowest that stays
  double error = std::numeric_limits<double>::infinity();  // share of the water that there is too much
};

// Opens land and water (`openLand`, `openWater`): land narrower than `first` times the narrowest that stays goes, then
// narrow water, then the rest of the land, and again water.
OpenedShores openShores(const ShoreGraph& graph, const ShoreSizes& sizes, const ShoreGuides& guides,
                        const FollowOptions& options, double first);

// Where both are narrow, what goes first leaves room for the other: the less land goes before water is closed, the less
// water there is in the end. As much goes first as brings the water's area near to what it was. `opened` was made with
// all of the land first.
OpenedShores balanceShores(OpenedShores&& opened, const ShoreGraph& graph, const ShoreSizes& sizes,
                           const ShoreGuides& guides, const FollowOptions& options);

}  // namespace coastmesh
