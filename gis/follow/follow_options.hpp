#pragma once

namespace coastmesh {

// Which parts of each region of water to keep, if closing divided it: all, the largest, or those at an open boundary
// (the largest if there are none). Modelled is like Open without those that the frame only grazes: less than a tenth of
// the largest at an open boundary. If all of those are less than a tenth of the water, the largest part is kept.
enum class KeepWater { All, Largest, Open, Modelled };

// The least width that is followed, as a multiple of the size there; 0: any width.
struct FollowOptions {
  double channel_min = 1.0;  // water
  double land_min = 1.0;     // land
  // Water in the data at least this wide that is the only connection of others is widened to `channel_min` instead of
  // closed.
  double strait_min = 0.2;
  KeepWater keep = KeepWater::All;
  bool of_land = false;  // land is meshed, so notes refer to land instead of water

  // Waters without any water this wide stay about as they are.
  double leastOfSmall() const { return channel_min > 0.0 && channel_min < 1.0 ? channel_min : 1.0; }
};

}  // namespace coastmesh
