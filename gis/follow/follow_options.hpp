#pragma once

namespace coastmesh {

// Of the parts of each region of water, into which closing may have cut it: all of them, the largest, or those at an
// open boundary, the largest where none is. Modelled is as Open without what the frame only grazes: less than a tenth
// of the largest at an open boundary. Where all of those are less than a tenth of the water, the largest stays.
enum class KeepWater { All, Largest, Open, Modelled };

// What is too narrow to be followed, as a multiple of the size wanted there; 0: nothing is.
struct FollowOptions {
  double channel_min = 1.0;  // water
  double land_min = 1.0;     // land
  // Water that alone joins others, no narrower than this, is made as wide as `channel_min` instead of closed.
  double strait_min = 0.4;
  KeepWater keep = KeepWater::All;
};

}  // namespace coastmesh
