#include "gis/elements/elements.hpp"
#include "gis/error.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"

namespace coastmesh {
namespace {

void requireParts(const std::vector<std::uint32_t>& parts, const std::string& path) {
  if (parts.empty())
    throw OutputError("'" + path + "': the mesh has no parts: give mesh --partition, or run partition");
}

// Writes SCHISM's partition.prop: for each element its number, from 1, and its rank, from 0. Throws OutputError.
void writeSchismPartition(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireParts(grid.part_of, path);
  TextWriter file(path);
  const Elements elements(grid);
  file.rows(loop, elements.size(), [&](TextBlock& text, std::size_t e) {
    text << e + 1 << ' ' << grid.part_of[elements.triangleOf(e)] << '\n';
  });
  file.close();
}

// Writes ADCIRC's partmesh.txt: the subdomain of each node, from 1. Throws OutputError.
void writeAdcircPartition(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireParts(grid.node_part_of, path);
  TextWriter file(path);
  file.rows(loop, grid.node_part_of.size(),
            [&](TextBlock& text, std::size_t n) { text << grid.node_part_of[n] + 1 << '\n'; });
  file.close();
}

}  // namespace

FormatRecord schismPartitionFormat() {
  return {{.name = "schism_partition",
           .endings = {".prop"},
           .description = "SCHISM's partition.prop, for --partition",
           .writable = true,
           .holds = {GridPart::Partition},
           .beside_grid = true},
          {writeSchismPartition, nullptr, nullptr}};
}

FormatRecord adcircPartitionFormat() {
  return {{.name = "adcirc_partition",
           .endings = {"partmesh.txt"},
           .description = "ADCIRC's partmesh.txt, for --partition",
           .writable = true,
           .holds = {GridPart::NodePartition},
           .beside_grid = true},
          {writeAdcircPartition, nullptr, nullptr}};
}

}  // namespace coastmesh
