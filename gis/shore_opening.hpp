#pragma once

#include <functional>

#include "gis/clean.hpp"
#include "gis/coast_follow.hpp"
#include "gis/shore_graph.hpp"

namespace coastmesh {

// Called with the kind of an edit, a place of the plane and the region of water beside it.
using ShoreEdit = std::function<void(EditKind, const Point&, RegionId)>;

// A morphological opening of the land, with disks of `narrowest` times the size wanted for diameters: what no disk fits into and ends in
// water goes (spits, capes); so do islands smaller than a triangle of that size. What joins two lands stays, and so does an island
// longer than three elements, however thin. 0 leaves all of it.
ShoreGraph openLand(const ShoreGraph& graph, const SizeFunction& size, double narrowest, const ShoreEdit& edit);

// A part of water that has become one of its own where what joined it was closed.
struct CutOffWater {
  Point place;  // inside
  double area = 0.0;
};

// The same for the water: what is narrower is closed (channels, heads of bays, corners), and so is water smaller than a few triangles.
// Triangles at lines inside the water and at a corner of an open boundary stay. Where nothing would be left, all stays.
// Of each water that falls apart, what `keep` says stays; `cut_off` is given the parts that it would not be if not all were kept.
ShoreGraph openWater(const ShoreGraph& graph, const SizeFunction& size, double narrowest, KeepWater keep,
                     const ShoreEdit& edit, std::vector<CutOffWater>& cut_off);

}  // namespace coastmesh
