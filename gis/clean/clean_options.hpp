#pragma once

#include "gis/error.hpp"

namespace coastmesh {

class AreasWithin;

// The treatment of vertices where rings, or a ring with itself, touch.
enum class Pinches {
  Keep,  // the vertex stays in both; it is reported
  Open,  // land recedes a little, so that water can pass: see `openPinches`
};

struct CleanOptions {
  double snap_m = 0.001;            // metres, 0 or more: points closer than this are merged (0 for a plane input)
  double simplify_m = 0.0;          // metres, 0 or more: no shore is moved further than this; see `simplifyEdges`
  double min_island_area_m2 = 0.0;  // square metres, 0 or more: smaller holes are filled, unless another area is there
  // Of all features, for `min_island_area_m2`; null: made for each call.
  const AreasWithin* areas = nullptr;
  bool dissolve = false;  // areas that share an edge become one, and the edge is removed
  Pinches pinches = Pinches::Keep;
};

// The group is outside the frame, or separate from the requested water: nothing to mesh, and no error.
struct NothingWanted : InputError {
  using InputError::InputError;
};

}  // namespace coastmesh
