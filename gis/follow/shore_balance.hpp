#pragma once

#include <limits>
#include <tuple>
#include <vector>

#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_opening.hpp"

namespace coastmesh {

using ShoreEdits = std::vector<std::tuple<EditKind, Point, RegionId>>;

// The triangulation to open shores in, and changes of the water so far.
struct ShoreStart {
  ShoreTriangles triangles;
  WaterAreas gained;
  ShoreEdits edits;
  std::vector<DroppedSpit> spits;
};

struct OpenedShores {
  ShoreTriangles before;  // after the first opening of land, as are the next three
  WaterAreas gained_before;
  std::size_t edits_before = 0, spits_before = 0;
  ShoreTriangles after;  // not settled
  SmallWaters small;     // by region, at the start
  std::vector<WaterPart> waters;
  WaterAreas areas, gained;
  ShoreEdits edits;
  std::vector<DroppedSpit> spits;
  double first = 1.0;  // width of land removed before water is closed, as a share of the narrowest that stays
  double error = std::numeric_limits<double>::infinity();  // excess of water, as a share of its area
};

// Opens land and water (`openLand`, `openWater`): removes land narrower than `first` times the narrowest that stays,
// closes narrow water and, if `first` < 1, removes the rest of the land and closes water again. Water all of
// which is narrower than an element stays as it is, and so does the land in it: without, it would become larger.
OpenedShores openShores(const ShoreStart& start, const ShoreSizes& sizes, const ShoreGuides& guides,
                        const FollowOptions& options, double first, const ItemLoop& loop = inOrder);

// Chooses `first` so that the water's area stays near the original. If both are narrow, what is removed first makes
// room for the other: the less land is removed before water is closed, the less water remains. REQUIRES: `opened` was
// made with `first` = 1.
OpenedShores balanceShores(OpenedShores&& opened, const ShoreStart& start, const ShoreSizes& sizes,
                           const ShoreGuides& guides, const FollowOptions& options, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
