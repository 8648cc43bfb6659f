#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// The edges of the polygons of rivers' water, in the CRS of the mesh. Edges between polygons that touch are not among
// them.
struct RiverBanks {
  std::vector<std::pair<Point, Point>> edges;
};

// Adds the polygons and closed lines of a vector file in any CRS; one without a CRS is taken to be in `crs`. Remarks
// about the file are appended to `warnings`. Throws InputError: unreadable, damaged, without polygons, with polygons
// that cannot be united or transformed.
void readRiverBanks(const std::string& path, const Crs& crs, RiverBanks& banks, std::vector<std::string>& warnings);

}  // namespace coastmesh
