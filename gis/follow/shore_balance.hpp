#pragma once

#include <limits>
#include <tuple>
#include <vector>

#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_opening.hpp"
#include "gis/follow/shore_straits.hpp"

namespace coastmesh {

using ShoreEdits = std::vector<std::tuple<EditKind, Point, RegionId>>;

// What shores are opened in, and what had become of the water before.
struct ShoreStart {
  ShoreTriangles triangles;
  WaterAreas gained;
  ShoreEdits edits;
  std::vector<DroppedSpit> spits;
};

struct OpenedShores {
  ShoreTriangles before;  // as it was when land that goes first had gone, and what had been gained and edited by then
  WaterAreas gained_before;
  std::size_t edits_before = 0, spits_before = 0;
  ShoreTriangles after;  // not settled
  std::vector<WaterPart> waters;
  std::vector<ClosedStrait> straits;  // by what was closed before the rest of the land went: see `allStraits`
  WaterAreas areas, gained;
  ShoreEdits edits;
  std::vector<DroppedSpit> spits;
  double first = 1.0;  // how narrow land went before water, as a share of the narrowest that stays
  double error = std::numeric_limits<double>::infinity();  // share of the water that there is too much
};

// Opens land and water (`openLand`, `openWater`): land narrower than `first` times the narrowest that stays goes, then
// narrow water, then the rest of the land, and again water.
OpenedShores openShores(const ShoreStart& start, const ShoreSizes& sizes, const ShoreGuides& guides,
                        const FollowOptions& options, double first);

// All straits that were closed. REQUIRES: `after` is not settled.
std::vector<ClosedStrait> allStraits(const OpenedShores& opened, const ShoreSizes& sizes);

// Where both are narrow, what goes first leaves room for the other: the less land goes before water is closed, the less
// water there is in the end. As much goes first as brings the water's area near to what it was. `opened` was made with
// all of the land first.
OpenedShores balanceShores(OpenedShores&& opened, const ShoreStart& start, const ShoreSizes& sizes,
                           const ShoreGuides& guides, const FollowOptions& options);

}  // namespace coastmesh
