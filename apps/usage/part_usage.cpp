#include "apps/usage/part_usage.hpp"

#include <vector>

#include "apps/usage/input_usage.hpp"
#include "gis/error.hpp"

namespace coastmesh {

void declarePart(OptionTable& table, CutRegion& region, const PartHelp& help) {
  table.section(Section::Domain);
  table.numbers(
      {"--bbox", "Bounding box"}, "W,S,E,N", false,
      [&region](const std::vector<double>& sides) { return storeBox(sides, region.box); },
      help.inside +
          " only triangles whose middle is in this box, in the mesh's CRS; in degrees, a box with E less than W "
          "crosses the antimeridian");
  table.texts({"--within", "Within polygons"}, region.within, kVectorFile, false,
              help.inside + " only triangles whose middle is in a polygon of this file, in any CRS; can be repeated");
  table.texts({"--outside", "Outside polygons"}, region.outside, kVectorFile, false,
              help.outside + " triangles whose middle is in a polygon of this file; can be repeated");
}

void requirePart(const CutRegion& region, const std::string& purpose) {
  if (!region.any())
    throw OptionError("nothing says which part of the mesh " + purpose + ": give --bbox, --within or --outside");
}

}  // namespace coastmesh
