#include "apps/usage/part_usage.hpp"

#include <algorithm>

#include "apps/usage/grid_usage.hpp"
#include "apps/usage/input_usage.hpp"
#include "apps/usage/option_keywords.hpp"
#include "apps/usage/target_usage.hpp"
#include "gis/coast/box_of_frame.hpp"
#include "gis/error.hpp"

namespace coastmesh {

void declarePart(OptionTable& table, PartUsage& usage, const PartHelp& help) {
  CutRegion& region = usage.region;
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

void declarePartOutputs(OptionTable& table, PartUsage& usage, const PartHelp& help) {
  declareTargets(table, usage.finish.targets, help.targets);
  declareGridOutputs(table, usage.outputs, usage.format);
  table.output({"--numbers", help.numbers_label}, usage.numbers, {}, help.numbers);
  table.flag({"--overwrite", "Replace files"}, usage.overwrite, "replace files that exist");
  table.section(Section::Run);
  table.flag({"--quiet", "No summary"}, usage.quiet, "print no summary");
}

void requirePart(const PartUsage& usage, const std::string& purpose) {
  if (!usage.region.any())
    throw OptionError("nothing says which part of the mesh " + purpose + ": give --bbox, --within or --outside");
  requireNumbers(usage);
}

void requireNumbers(const PartUsage& usage) {
  if (!usage.numbers.empty() && !usage.finish.targets.empty())
    throw OptionError(
        "--numbers: repairs for --target add, move and remove nodes, so that numbers are no longer those of the mesh; "
        "leave --target out, and repair with convert --target if check finds anything");
}

std::vector<std::uint8_t> requireTriangles(const PartUsage& usage, const Grid& grid, const std::string& path,
                                           const std::string& purpose, std::vector<std::string>& warnings,
                                           const ItemLoop& loop) {
  std::vector<std::uint8_t> taken = trianglesIn(usage.region, grid, warnings, loop);
  if (std::ranges::find(taken, 1) == taken.end())
    throw InputError("no triangle of '" + path + "' has its middle in the part " + purpose +
                     "; the mesh extends, as W,S,E,N, over " + inWords(boxAround(grid.nodes, loop)) +
                     (grid.crs.isPlane() ? "" : " (" + nameOf(grid.crs) + ")"));
  return taken;
}

}  // namespace coastmesh
