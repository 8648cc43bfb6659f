#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"

namespace coastmesh {

// A ring or line of the input while it is cleaned.
struct TouchChain {
  std::vector<Point>* points = nullptr;  // a ring's first point is not repeated
  bool closed = true;
};

// A point that was put into an edge it lies on.
struct Touch {
  std::size_t chain;
  Point place;
};

// Points that lie on an edge of another chain, or of their own, become points of that edge as well: what touches in the
// input's coordinates (polygons cut along a grid of longitudes, say) must touch in the working plane too, where its
// edges run a little differently. On an edge lies what is no further from it than `tolerance`, 0 or more, or than
// coordinates are rounded, in the coordinates' own unit; what is as near to one of its ends is left to snapping. Edges
// wider than `widest` are left alone: longitudes that jump from one end of the map to the other do not run between.
std::vector<Touch> insertTouchingPoints(const std::vector<TouchChain>& chains, double tolerance,
                                        double widest = std::numeric_limits<double>::infinity(),
                                        const ItemLoop& loop = inOrder);

}  // namespace coastmesh
