#include "apps/usage/finish_usage.hpp"

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "apps/usage/target_usage.hpp"

namespace coastmesh {

namespace {

// Declares a choice of names, in the order of the enumerators of `value`.
template <typename Enum, std::size_t N>
void declareEnum(OptionTable& table, const OptionNames& names, Enum& value, const std::array<const char*, N>& choices,
                 const std::string& help) {
  const std::vector<std::string> all(choices.begin(), choices.end());
  table.choice(
      names, all[static_cast<std::size_t>(value)], all,
      [&value, all](const std::string& chosen) {
        for (std::size_t i = 0; i < all.size(); ++i)
          if (all[i] == chosen) value = static_cast<Enum>(i);
      },
      help);
}

}  // namespace

void declareDepths(OptionTable& table, DepthOptions& depth, const std::string& help,
                   const std::vector<std::string>& interpolated) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  table.section(Section::Depths);
  table.texts({"--bathymetry", "Depth rasters"}, depth.files, kRasterFile, false, help);
  table.needing(interpolated, [&] {
    declareEnum(table, {"--depth-method", "Interpolation of depths"}, depth.method, kDepthMethodNames,
                "between the four pixels around a node, or the average over the pixels in its triangles");
  });
  table.needing({"--bathymetry"}, [&] {
    table.choice(
        {"--depth-sign", "Sign of depths"}, "up", {"up", "down"},
        [&depth](const std::string& chosen) { depth.positive_down = chosen == "down"; },
        "up: the rasters hold elevations; down: they hold depths");
    table.number({"--water-level", "Water level"}, depth.water_level_m, "M", {-kInfinity, kInfinity},
                 "height of the still water above the rasters' zero; depths are measured from it");
    table.number({"--min-depth", "Minimum depth"}, depth.min_depth_m, "M", {-kInfinity, kInfinity},
                 "lower nodes that are shallower than this");
  });
}

void declareFields(OptionTable& table, std::vector<FieldSource>& fields) {
  table.section(Section::Depths);
  table.textsWithFiles(
      {"--attribute", "Nodal attributes"}, "NAME=SOURCE",
      [&fields](const std::string& text) { return addFieldSource(text, fields); }, filesOfFieldSource,
      "value of a model at nodes, such as manning: NAME=FILE, a raster, interpolated as depths are; "
      "NAME=FILE,TABLE.csv, "
      "a raster of classes and a table of class and value, averaged over the pixels in a node's triangles; "
      "NAME=NUMBER, all nodes, or those for which no raster has a value; can be repeated, the first with a value at a "
      "node is used");
}

void declareFinishOptions(OptionTable& table, FinishOptions& options) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  DepthOptions& depth = options.depth;
  declareDepths(table, depth,
                "raster with the depths of the nodes; can be repeated, the first with a value at a node is used",
                {"--bathymetry", "--attribute"});
  table.needing({"--bathymetry", "--attribute"}, [&] {
    declareEnum(table, {"--depth-fill", "Nodes without a depth"}, depth.fill, kDepthFillNames,
                "value of nodes for which no raster has one: the mean of their neighbours, the value of the nearest "
                "node, or none");
  });
  declareFields(table, options.fields);
  BoundaryOptions& boundaries = options.boundaries;
  table.section(Section::Boundaries);
  table.texts({"--boundaries", "Boundary types"}, boundaries.files, kVectorFile, false,
              "polygons, or lines along the shore, with a column that sets the type of the boundary there: land, open, "
              "river or an ADCIRC boundary number; can be repeated, the last is used");
  table.text({"--boundary-column", "Column of boundary types"}, boundaries.column, "NAME",
             "column with the boundary types, also in INPUT if given; default: the first column named type, role, "
             "boundary, ibtype or kind");
  table.number({"--open-deeper", "Open where deeper than"}, boundaries.open_deeper_m, "M", {-kInfinity, kInfinity},
               "outer boundaries are open where they are deeper than this; sides of a frame are open across all water");
  table.number({"--min-boundary", "Minimum boundary length"}, boundaries.least_length_m, "M", {0.0, kInfinity},
               "boundaries shorter than this are merged into the longer one beside them");
  declareTargets(table, options.targets, "repair what the model would reject, and report each repair; can be repeated");
}

}  // namespace coastmesh
