#include "apps/cli/partition_outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/cli/shard_file.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/globe/fesom_levels.hpp"

namespace coastmesh {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFesomParts = "fesom_partition";
constexpr std::string_view kEven = "even";

bool anyHolds(const std::vector<std::string>& outputs, const std::string& format, GridPart part) {
  return std::ranges::any_of(withoutShardFiles(outputs),
                             [&](const std::string& path) { return gridFormatFor(path, format).holds.has(part); });
}

bool anyIs(const std::vector<std::string>& outputs, const std::string& format, std::string_view name) {
  return std::ranges::any_of(outputs,
                             [&](const std::string& path) { return gridFormatFor(path, format).name == name; });
}

void requireNumberOfParts(std::uint64_t parts, const std::vector<std::string>& outputs, const std::string& format) {
  for (const std::string& path : outputs)
    if (parts == 0 && gridFormatFor(path, format).beside_grid)
      throw OptionError("'" + path + "' holds the parts of a mesh: give their number with --partition");
  for (const std::string& path : outputs) {
    const GridFormat& known = gridFormatFor(path, format);
    if (known.name != kFesomParts) continue;
    const std::size_t for_parts = filesOf(known, path).targets.size() / 2;  // two per process, and one for all
    if (for_parts != parts)
      throw OptionError("'" + path + "': this folder is for " + std::to_string(for_parts) + " processes, not for " +
                        std::to_string(parts));
  }
}

// The levels of the mesh whose folder dist_N is written: those that are written with it in this run, or those beside
// that folder.
VerticalLevels fesomLevels(const std::vector<std::string>& outputs, const std::string& format) {
  for (const std::string& path : outputs) {
    if (gridFormatFor(path, format).name != kFesomParts || anyIs(outputs, format, "fesom")) continue;
    const fs::path beside = fs::absolute(path).parent_path().parent_path() / "aux3d.out";
    if (fs::exists(beside)) return {{}, readVerticalLevels(beside.string()).levels};
  }
  const std::vector<int> depths = fesomLevelDepths();
  return {{}, FesomLevels{{depths.begin(), depths.end()}}};
}

std::optional<VerticalLevels> levelsFor(const PartsUsage& usage, const std::vector<std::string>& outputs,
                                        const std::string& format) {
  if (!usage.levels.empty()) {
    if (!isLevelFile(usage.levels))
      throw OptionError("--partition-levels " + usage.levels +
                        ": by its name it is neither a vgrid.in of SCHISM nor an aux3d.out of FESOM2");
    return readVerticalLevels(usage.levels);
  }
  if (!usage.weight.empty() || !anyIs(outputs, format, kFesomParts)) return {};
  return fesomLevels(outputs, format);
}

}  // namespace

void declarePartWeights(OptionTable& table, PartsUsage& usage) {
  table
      .text({"--partition-weight", "Work of parts"}, usage.weight, "NAME",
            "what all parts have the same amount of: even, elements, or neighbours of nodes; or the nodal attribute of "
            "this name; without it layers of water for dist_N/rpart.out (FESOM2), otherwise even")
      .ignoredWith({"--partition-levels"});
  table.text({"--partition-levels", "Vertical levels for parts"}, usage.levels, "FILE",
             "give all parts the same number of layers of water, counted with the levels of this file: SCHISM's "
             "vgrid.in or FESOM2's aux3d.out");
}

void declareParts(OptionTable& table, PartsUsage& usage, const std::vector<std::string>& outputs,
                  const std::string& format) {
  table
      .integer({"--partition", "Number of parts"}, usage.parts, "N", 0, kMostParts,
               "assign the mesh to N processes of a solver, 0: none; written to outputs named partition.prop (SCHISM), "
               "partmesh.txt (ADCIRC) or dist_N/rpart.out (FESOM2), and in .nc and .msh")
      .needs(
          [&outputs, &format] {
            return anyHolds(outputs, format, GridPart::Partition) || anyHolds(outputs, format, GridPart::NodePartition);
          },
          "without an output that holds parts (.prop, partmesh.txt, rpart.out, .nc, .msh)");
  table.needing({"--partition"}, [&] { declarePartWeights(table, usage); });
}

PartitionOptions partitionFor(const PartsUsage& usage, const std::vector<std::string>& outputs,
                              const std::string& format) {
  requireNumberOfParts(usage.parts, outputs, format);
  PartitionOptions options{static_cast<std::uint32_t>(usage.parts), anyHolds(outputs, format, GridPart::Partition),
                           anyHolds(outputs, format, GridPart::NodePartition)};
  if (usage.parts == 0) return options;
  options.levels = levelsFor(usage, outputs, format);
  if (!options.levels && usage.weight != kEven) options.attribute = usage.weight;
  return options;
}

}  // namespace coastmesh
