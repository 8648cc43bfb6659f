#pragma once

#include <string>

#include "gis/crs/crs.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// "-88.05,41.6,-84.7,46.15"
std::string inWords(const Box& box);

// Degrees of longitude from the west to the east of a box; an east less than the west lies beyond the antimeridian.
double widthOf(const Box& box);

// Throws OptionError for a box without width or height, InputError for one that is invalid in the input's CRS.
void refuseOddBox(const Box& box, const Crs& crs);

// An east less than the west means a box across the antimeridian. Notes that it may be a mistake if that spans most of
// the Earth; else empty.
std::string wideBoxNote(const Box& box, const Crs& crs);

// A warning that the box goes on past the edge of a plane such as Mercator's, where the input, which reaches over
// `data`, does not: it has that land at the other edge. Else empty.
std::string beyondEdgeWarning(const Box& box, const Box& data, const Crs& crs);

}  // namespace coastmesh
