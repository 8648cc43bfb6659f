#pragma once

#include <string>
#include <vector>

#include "gis/clean/followed_waters.hpp"
#include "gis/follow/follow_options.hpp"

namespace coastmesh {

// "12.3 km²"; in a plane, whose unit is unknown, the number alone.
std::string areaInWords(double area_m2, bool in_plane);

struct NotesAndWarnings {
  std::vector<std::string> notes, warnings;
};

// Sentences on waters that following sizes has left out, separated from the largest, or joined by widening straits,
// with their shares of all water: a warning if more is left out or separated than is acceptable for a model, otherwise
// notes.
NotesAndWarnings noteWaters(const FollowedWaters& waters, const FollowOptions& options);

// A warning if the meshed area, `meshed_m2`, differs from the original, without waters that were left out, by more than
// is acceptable for a model: sizes are then larger than much of the water. Otherwise empty.
std::string warningOfArea(const FollowedWaters& waters, const FollowOptions& options, double meshed_m2);

}  // namespace coastmesh
