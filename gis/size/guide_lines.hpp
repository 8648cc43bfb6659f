#pragma once

#include <string>
#include <vector>

#include "gis/crs/crs.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// Reads the lines of all vector layers of `source`, with their attribute `name` if present, and transforms them to
// `crs`; a source without a CRS is assumed to be in it. Throws InputError: unreadable, no lines, no transformation
// between the CRS, a place that `crs` does not reach.
std::vector<ShoreLine> readGuideLines(const std::string& source, const Crs& crs);

// Projects lines to the plane; drops those that leave the area of the projection.
std::vector<ShoreLine> projected(const std::vector<ShoreLine>& lines, const Projection& projection);

}  // namespace coastmesh
