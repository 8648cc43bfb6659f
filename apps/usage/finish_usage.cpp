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

void declareFinishOptions(OptionTable& table, FinishOptions& options) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  DepthOptions& depth = options.depth;
  table.section(Section::Depths);
  table.texts({"--bathymetry", "Rasters of depths"}, depth.files, kRasterFile, false,
              "raster that gives the nodes their depth; repeat it for several, the first that has a value counts");
  table.needing({"--bathymetry"}, [&] {
    declareEnum(table, {"--depth-method", "Depth at a node"}, depth.method, kDepthMethodNames,
                "depth between the four pixels round a node, or the average over the pixels in its triangles");
    table.choice(
        {"--depth-sign", "Sign of the rasters"}, "up", {"up", "down"},
        [&depth](const std::string& chosen) { depth.positive_down = chosen == "down"; },
        "whether the rasters hold elevations (positive up) or depths (positive down)");
    table.number({"--water-level", "Water level"}, depth.water_level_m, "M", {-kInfinity, kInfinity},
                 "height of the still water above the rasters' zero, which depths are counted from");
    table.number({"--min-depth", "Least depth"}, depth.min_depth_m, "M", {-kInfinity, kInfinity},
                 "nodes shallower than this are lowered");
    declareEnum(
        table, {"--depth-fill", "Nodes without a depth"}, depth.fill, kDepthFillNames,
        "what nodes get for which no raster has a value: the mean of their neighbours, the value of the nearest "
        "node, or none");
  });
  BoundaryOptions& boundaries = options.boundaries;
  table.section(Section::Boundaries);
  table.texts(
      {"--boundaries", "Types of boundaries"}, boundaries.files, kVectorFile, false,
      "polygons, or lines along the shore, whose column says what the boundary is there: land, open or river, or a "
      "number of ADCIRC's; repeat it for several, the last counts");
  table.text(
      {"--boundary-column", "Column of the types"}, boundaries.column, "NAME",
      "the column with the types of boundaries, in INPUT too where it is given; else the first called type, role, "
      "boundary, ibtype or kind");
  table.number(
      {"--open-deeper", "Open where deeper than"}, boundaries.open_deeper_m, "M", {-kInfinity, kInfinity},
      "boundaries of outer loops are open where they are deeper than this; sides of a frame are open everywhere");
  table.number({"--min-boundary", "Shortest boundary"}, boundaries.least_length_m, "M", {0.0, kInfinity},
               "boundaries shorter than this become part of the longer one beside them");
  declareTargets(table, options.targets,
                 "mend what would make the model refuse the mesh, each repair being reported; repeat it for several");
}

}  // namespace coastmesh
