#pragma once

#include <vector>

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/size_function.hpp"
#include "gis/projection/scale_table.hpp"

namespace coastmesh {

// An island: land that its water surrounds, in the plane.
struct IslandRing {
  std::vector<Point> points;  // clockwise: the water is to the left
  double area = 0.0;          // plane units
};

// The islands of a labelled graph.
std::vector<IslandRing> islandRings(const Pslg& pslg);

// An island that is not in a graph any more.
struct LostIsland {
  Point place;           // far from its shore
  double area_m2 = 0.0;  // on the ground
};

// The islands with the area of at least `elements` equilateral triangles of the size there, on the ground, of which
// nothing is left in a graph made from theirs: they are narrower than their area says. `after` is labelled.
std::vector<LostIsland> lostIslands(const std::vector<IslandRing>& before, const Pslg& after, const SizeFunction& size,
                                    const ScaleTable& scales, double elements, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
