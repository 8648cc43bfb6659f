#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

enum class DomainSide {
  Auto,     // inside polygons; lines within a frame are coasts
  Inside,   // inside polygons and closed lines
  Outside,  // the frame's water, without land polygons and beyond coasts
  Ocean,    // the water of the whole Earth, outside land polygons in degrees
  Land,     // the land polygons themselves, without a frame
  Globe,    // both sides of all shores, on the whole globe: a closed mesh
};

// The limits of the domain besides the shores.
struct FrameOptions {
  DomainSide side = DomainSide::Auto;
  // West, south, east, north, in the input's CRS. In degrees, an east less than the west is beyond the antimeridian.
  std::optional<Box> box{};
  std::optional<Point> water_at{};  // in the input's CRS
  bool in_plane = false;            // the input's coordinates are the working plane
};

// Results of framing.
struct FrameReport {
  std::uint64_t beyond_frame = 0;     // features completely outside the frame: left out
  std::vector<std::string> notes;     // decisions where the options were ambiguous
  std::vector<std::string> warnings;  // frames that are probably a mistake
};

// Sets the uses of the features of `coastline`: polygons become land, or polygons and lines coasts, as the options say.
// A box becomes a feature of use Frame; such features that meet are united. Features completely outside the frame are
// left out, and parts far outside are cut off at some distance, so that the working plane need not show them; nothing
// within the frame changes. Frames whose longitudes jump, or lie in another range than those of the other features, are
// split at the antimeridian. For a whole globe, adds a last feature for everything outside the others. Throws
// OptionError for a box without width or height; InputError for a side that needs a frame and has none, for a box that
// is invalid in the input's CRS, and for a frame without any input.
FrameReport frameCoastline(Coastline& coastline, const FrameOptions& options);

}  // namespace coastmesh
