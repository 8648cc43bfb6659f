#pragma once

namespace coastmesh {

// How near points come before cleaning merges them.
struct SnapDistance {
  double length = 0.0;    // metres on the ground, or units of the coordinates; 0 or more
  bool in_plane = false;  // the coordinates are taken as they are, whatever their CRS
};

}  // namespace coastmesh
