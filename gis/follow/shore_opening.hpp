#pragma once

#include <functional>
#include <map>

#include "gis/clean/clean.hpp"
#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/follow/shore_triangles.hpp"

namespace coastmesh {

// A morphological opening of the land, with disks of `narrowest` times the size wanted for diameters: what no disk fits
// into and ends in water goes (spits, capes); so do islands smaller than a triangle of that size. What joins two lands
// stays, and so does an island longer than three elements, however thin. 0 leaves all of it. What regions of water gain
// is added to `gained`, as below. The triangles are settled.
void openLand(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
              const ShoreEdit& edit, WaterAreas& gained);

// A part of a region of water that nothing joins to the others, mostly since what did was closed.
struct WaterPart {
  RegionId region = kUnlabelled;
  double area = 0.0;          // square metres
  bool at_open = false;       // its open boundary is long enough for an element
  bool kept = false;          // what `KeepWater` says, save that All takes what Modelled does not
  std::vector<Point> inside;  // places in its largest triangles, the largest first
};

struct OpenedWater {
  std::vector<WaterPart> waters;
  WaterAreas areas;
};

// The same for the water: what is narrower is closed (channels, heads of bays, corners), and so is water smaller than a
// few triangles. Triangles at lines inside the water and at a corner of an open boundary stay. Where nothing would be
// left, all stays. Of the parts of each region of water, what `keep` says stays. What is left out so is not taken from
// `gained`. The triangles are not settled.
OpenedWater openWater(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, double narrowest,
                      KeepWater keep, const ShoreEdit& edit, WaterAreas& gained);

}  // namespace coastmesh
