#pragma once

namespace coastmesh {

// The distance within which cleaning merges points.
struct SnapDistance {
  double length = 0.0;    // metres on the ground, or units of the coordinates; 0 or more
  bool in_plane = false;  // coordinates are used as given, whatever their CRS
};

}  // namespace coastmesh
