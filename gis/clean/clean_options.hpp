#pragma once

#include "gis/error.hpp"

namespace coastmesh {

// What becomes of a place where rings, or a ring with itself, touch in one vertex.
enum class Pinches {
  Keep,  // the vertex stays in both; it is reported
  Open,  // land gives way a little, so that water passes: see `openPinches`
};

struct CleanOptions {
  double snap_m = 0.001;            // metres, 0 or more: points nearer than this become one (0 for a plane input)
  double simplify_m = 0.0;          // metres, 0 or more: no shore is moved further than this; see `simplifyEdges`
  double min_island_area_m2 = 0.0;  // square metres, 0 or more: smaller holes are filled
  bool dissolve = false;            // areas that share an edge become one, and the edge goes
  Pinches pinches = Pinches::Keep;
};

// The group lies outside of the frame, or apart from the water asked for: there is nothing to mesh, and nothing wrong.
struct NothingWanted : InputError {
  using InputError::InputError;
};

}  // namespace coastmesh
