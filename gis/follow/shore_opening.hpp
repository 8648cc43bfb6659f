#pragma once

#include <functional>
#include <map>
#include <vector>

#include "gis/clean/clean.hpp"
#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/shore_triangles.hpp"

namespace coastmesh {

// Land that ended in water and was removed, more than three elements long.
struct DroppedSpit {
  Point place;  // its end
  double length_m = 0.0;
};

// For each region of water, the first of those that it is connected with: features with a common border are one water.
using ConnectedRegions = std::vector<RegionId>;

ConnectedRegions connectedRegions(const ShoreTriangles& triangles, const ItemLoop& loop = inOrder);

// Waters no triangle of which is `narrowest` times the size wide, or stays for another reason: `openWater` closes
// nothing of them.
SmallWaters smallWaters(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
                        const ConnectedRegions& connected, const ItemLoop& loop = inOrder);

// A morphological opening of the land, with disks of `narrowest` times the size there as diameter: removes land that no
// disk fits into and that ends in water (spits, capes), and islands smaller than a triangle of that size. Keeps blunt
// corners, land that connects two lands, and islands longer than three elements, however thin. With 0, removes only
// small islands. Land in waters that are `small` stays. The gain of each region of water is added to `gained`, as
// below, and long spits to `spits`. Settles the triangles.
void openLand(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
              const SmallWaters& small, const ShoreEdit& edit, WaterAreas& gained, std::vector<DroppedSpit>& spits,
              const ItemLoop& loop = inOrder);

// A part of a water without a connection to the others, mostly because this was closed.
struct WaterPart {
  RegionId whole = kUnlabelled;  // of all parts of the water: its region, the first if several are connected
  double area = 0.0;             // square metres
  WaterAreas areas{};            // the same by region
  bool at_open = false;          // its open boundary is at least one element long
  bool kept = false;             // by `KeepWater`; for All as for Modelled
  bool small = false;            // nothing of its water was closed, as all would have been
  std::vector<Point> inside;     // points in its largest triangles, the largest first
  std::vector<TriId> triangles;  // before settling
};

struct OpenedWater {
  std::vector<WaterPart> waters;
  WaterAreas areas;
};

// The same for water: closes narrower parts (channels, heads of bays, corners), and water smaller than a few triangles.
// Triangles at vertices of borders in the water, along passages and at a corner of an open boundary stay. If nothing
// would be left of a water, all of it stays. Then keeps the parts of each water by `keep`, regions that were connected
// before (`connected`) being one water; those left out are not subtracted from `gained`. Does not settle the triangles.
OpenedWater openWater(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
                      KeepWater keep, const ConnectedRegions& connected, const ShoreEdit& edit, WaterAreas& gained,
                      const ItemLoop& loop = inOrder);

}  // namespace coastmesh
