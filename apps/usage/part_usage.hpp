#pragma once

#include <string>

#include "apps/usage/option_table.hpp"
#include "gis/cut/cut_region.hpp"

namespace coastmesh {

// What becomes of triangles in the part that options choose, and in polygons of --outside: "keep", "leave out".
struct PartHelp {
  std::string inside, outside;
};

// Declares --bbox, --within and --outside.
void declarePart(OptionTable& table, CutRegion& region, const PartHelp& help);

// To be called once all is set. `purpose`: "to cut out". Throws OptionError if no option chooses the part.
void requirePart(const CutRegion& region, const std::string& purpose);

}  // namespace coastmesh
