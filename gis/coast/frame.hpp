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
  Outside,  // the frame's water: what land polygons and coasts leave of it
  Ocean,    // the water that land polygons, in degrees, leave of the whole Earth
  Land,     // the polygons themselves, of land, without a frame
  Globe,    // both sides of all shores, round the whole globe: a closed mesh
};

// What bounds the domain besides the shores.
struct FrameOptions {
  DomainSide side = DomainSide::Auto;
  // West, south, east, north, in the input's CRS; where that has degrees, an east below the west lies beyond the
  // antimeridian.
  std::optional<Box> box;
  std::optional<Point> water_at;  // in the input's CRS
};

// What framing did.
struct FrameReport {
  std::uint64_t beyond_frame = 0;  // features that lie wholly outside of the frame: left out
  std::vector<std::string> notes;  // what was decided where the options left a choice
};

// Gives the features of `coastline` their uses: polygons become land, or lines coasts, as the options say; a box
// becomes a feature of use Frame, as those have that were read with it. What lies wholly beyond the frame is left out,
// and what reaches far beyond is cut off a little way outside, so that the working plane need not show it: nothing
// within the frame is changed. For a whole globe the last feature becomes what no other holds. Throws OptionError:
// a box without width or height. Throws InputError: a side without a frame, a box that is none in the input's CRS, a
// frame that holds nothing of the input.
FrameReport frameCoastline(Coastline& coastline, const FrameOptions& options);

}  // namespace coastmesh
