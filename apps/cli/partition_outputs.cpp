#include "apps/cli/partition_outputs.hpp"

#include <algorithm>

#include "apps/cli/shard_file.hpp"
#include "gis/format/grid_io.hpp"

namespace coastmesh {

namespace {

bool anyHolds(const std::vector<std::string>& outputs, const std::string& format, GridPart part) {
  return std::ranges::any_of(withoutShardFiles(outputs),
                             [&](const std::string& path) { return gridFormatFor(path, format).holds.has(part); });
}

}  // namespace

void declareParts(OptionTable& table, std::uint64_t& parts, const std::vector<std::string>& outputs,
                  const std::string& format) {
  table
      .integer({"--partition", "Number of parts"}, parts, "N", 0, kMostParts,
               "assign the mesh to N processes of a solver, 0: none; written to outputs named partition.prop (SCHISM), "
               "partmesh.txt (ADCIRC) or dist_N/rpart.out (FESOM2), and in .nc and .msh")
      .needs(
          [&outputs, &format] {
            return anyHolds(outputs, format, GridPart::Partition) || anyHolds(outputs, format, GridPart::NodePartition);
          },
          "without an output that holds parts (.prop, partmesh.txt, rpart.out, .nc, .msh)");
}

PartitionOptions partitionFor(std::uint64_t parts, const std::vector<std::string>& outputs, const std::string& format) {
  for (const std::string& path : outputs)
    if (parts == 0 && gridFormatFor(path, format).beside_grid)
      throw OptionError("'" + path + "' holds the parts of a mesh: give their number with --partition");
  for (const std::string& path : outputs) {
    const GridFormat& known = gridFormatFor(path, format);
    if (known.name != "fesom_partition") continue;
    const std::size_t for_parts = filesOf(known, path).targets.size() / 2;  // two per process, and one for all
    if (for_parts != parts)
      throw OptionError("'" + path + "': this folder is for " + std::to_string(for_parts) + " processes, not for " +
                        std::to_string(parts));
  }
  return {static_cast<std::uint32_t>(parts), anyHolds(outputs, format, GridPart::Partition),
          anyHolds(outputs, format, GridPart::NodePartition)};
}

}  // namespace coastmesh
