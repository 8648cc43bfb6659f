#pragma once

namespace coastmesh {

// Of the parts of each region of water, into which closing may have cut it: all of them, the largest, or those at an open boundary, the
// largest where none is.
enum class KeepWater { All, Largest, Open };

// What is too narrow to be followed, as a multiple of the size wanted there; 0: nothing is.
struct FollowOptions {
  double channel_min = 1.0;  // water
  double land_min = 1.0;     // land
  KeepWater keep = KeepWater::All;
};

}  // namespace coastmesh
