#pragma once

namespace coastmesh {

// The distance within which cleaning merges points.
struct SnapDistance {
  double length = 0.0;    // metres on the ground, or units of the coordinates; 0 or more
  bool in_plane = false;  // coordinates are used as given, whatever their CRS
};

// Gaps up to this length may be inaccuracies of data, which messages advise to snap; larger distances would merge what
// is apart.
inline constexpr double kMostSnapped = 100.0;  // metres

}  // namespace coastmesh
