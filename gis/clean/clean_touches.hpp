#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"

namespace coastmesh {

// A ring, line or point of the input while it is cleaned.
struct TouchChain {
  std::vector<Point>* points = nullptr;  // a ring's first point is not repeated
  bool closed = true;
};

// A point inserted into an edge that it lies on.
struct Touch {
  std::size_t chain;
  Point place;
};

// Inserts points that lie on an edge of another chain, or of their own, into that edge: features that touch in the
// input's coordinates (such as polygons cut along a grid of longitudes) must touch in the working plane too, where
// edges are slightly different lines. A point is on an edge if it is within `tolerance`, 0 or more, or within the
// rounding of coordinates, in their own unit; points that close to an end of the edge are left to snapping. Edges wider
// than `widest` are skipped: if longitudes jump from one end of the map to the other, no edge runs between.
std::vector<Touch> insertTouchingPoints(const std::vector<TouchChain>& chains, double tolerance,
                                        double widest = std::numeric_limits<double>::infinity(),
                                        const ItemLoop& loop = inOrder);

}  // namespace coastmesh
