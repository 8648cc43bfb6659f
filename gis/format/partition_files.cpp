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
  file.rows(loop, grid.part_of.size(),
            [&](TextBlock& text, std::size_t t) { text << t + 1 << ' ' << grid.part_of[t] << '\n'; });
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
  return {{"schism_partition",
           {".prop"},
           "SCHISM's partition.prop, for --partition",
           false,
           true,
           {GridPart::Partition},
           false,
           NodePlaces::AsTheyAre,
           false,
           true},
          {writeSchismPartition, nullptr, nullptr}};
}

FormatRecord adcircPartitionFormat() {
  return {{"adcirc_partition",
           {"partmesh.txt"},
           "ADCIRC's partmesh.txt, for --partition",
           false,
           true,
           {GridPart::NodePartition},
           false,
           NodePlaces::AsTheyAre,
           false,
           true},
          {writeAdcircPartition, nullptr, nullptr}};
}

}  // namespace coastmesh
