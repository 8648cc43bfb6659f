#pragma once

#include <string>
#include <vector>

#include "gis/crs/crs.hpp"
#include "gis/follow/shore_guides.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// Reads the lines of all vector layers of `source`, each with its attribute `name`, where there is one, and brings them
// to `crs`; a source without a CRS is taken to be in it. Throws InputError: unreadable, no lines, no way between the
// CRS.
std::vector<ShoreLine> readGuideLines(const std::string& source, const Crs& crs);

// In the plane; without lines that leave what the projection reaches.
std::vector<ShoreLine> projected(const std::vector<ShoreLine>& lines, const Projection& projection);

}  // namespace coastmesh
