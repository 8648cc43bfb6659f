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

// For each kind of change by following sizes, a sentence on all groups of features: waters left out, separated from the
// largest, joined by widening straits, or too small for an element, with their shares of all water; straits closed,
// land removed, and points on the shore. A warning if more is left out or separated than is acceptable for a model,
// otherwise a note.
NotesAndWarnings noteWaters(const FollowedWaters& waters, const FollowOptions& options);

// A warning if the meshed area, `meshed_m2`, differs from the original, without waters that were left out, by more than
// is acceptable for a model: sizes are then larger than much of the water. Otherwise empty.
std::string warningOfArea(const FollowedWaters& waters, const FollowOptions& options, double meshed_m2);

}  // namespace coastmesh
