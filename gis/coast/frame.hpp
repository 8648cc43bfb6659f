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
  Land,     // the polygons themselves, of land, without a frame
  Globe,    // both sides of all shores, on the whole globe: a closed mesh
};

// The limits of the domain besides the shores.
struct FrameOptions {
  DomainSide side = DomainSide::Auto;
  // West, south, east, north, in the input's CRS; if that is in degrees, an east below the west is beyond the
  // antimeridian.
  std::optional<Box> box{};
  std::optional<Point> water_at{};  // in the input's CRS
};

// Results of framing.
struct FrameReport {
  std::uint64_t beyond_frame = 0;  // features completely outside the frame: left out
  std::vector<std::string> notes;  // decisions where the options were ambiguous
};

// Sets the uses of the features of `coastline`: polygons become land, or lines coasts, as the options say; a box
// becomes a feature of use Frame, like those read as a frame, of which those that meet are united. Features completely
// outside the frame are left out, and parts far outside are cut off at some distance, so that the working plane need
// not show them: nothing within the frame changes. For a whole globe the last feature becomes what no other contains.
// Throws OptionError: a box without width or height. Throws InputError: a side without a frame, a box that is invalid
// in the input's CRS, a frame without any input.
FrameReport frameCoastline(Coastline& coastline, const FrameOptions& options);

}  // namespace coastmesh
