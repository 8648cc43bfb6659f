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

// A morphological opening of the land, with disks of `narrowest` times the size there as diameter: land that no disk
// fits into and that ends in water is removed (spits, capes), and so are islands smaller than a triangle of that size.
// Blunt corners stay, land that connects two lands, and an island longer than three elements, however thin. 0 keeps
// everything. The gain of each region of water is added to `gained`, as below, and long spits to `spits`. The triangles
// are settled.
void openLand(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
              const ShoreEdit& edit, WaterAreas& gained, std::vector<DroppedSpit>& spits);

// A part of a region of water without a connection to the others, mostly because that was closed.
struct WaterPart {
  RegionId region = kUnlabelled;
  double area = 0.0;          // square metres
  bool at_open = false;       // its open boundary is at least one element long
  bool kept = false;          // as `KeepWater` says, except that All does not count what Modelled would drop
  std::vector<Point> inside;  // points in its largest triangles, the largest first
};

struct OpenedWater {
  std::vector<WaterPart> waters;
  WaterAreas areas;
};

// The same for the water: narrower parts are closed (channels, heads of bays, corners), and so is water smaller than a
// few triangles. Triangles at lines inside the water and at a corner of an open boundary stay. If nothing would be
// left, all stays. Of the parts of each region of water, those that `keep` says stay. What is left out in this way is
// not subtracted from `gained`. The triangles are not settled.
OpenedWater openWater(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
                      KeepWater keep, const ShoreEdit& edit, WaterAreas& gained);

}  // namespace coastmesh
