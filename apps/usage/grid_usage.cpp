#include "apps/usage/grid_usage.hpp"

#include "gis/format/grid_io.hpp"

namespace coastmesh {

void declareAssumedCrs(OptionTable& table, std::string& crs) {
  table.section(Section::Input);
  table.text({"--assume-crs", "CRS of the mesh"}, crs, "CRS",
             "CRS of the mesh, if its file has none; default: a plane");
}

void declareGridOutputs(OptionTable& table, std::vector<std::string>& outputs, std::string& format) {
  const auto files = [&format](const std::string& path) { return filesOf(gridFormatFor(path, format), path); };
  table.section(Section::Output);
  table.outputs({"-o,--output", "Outputs"}, outputs, {.required = true, .files = files},
                "mesh to write; can be repeated");
  table.text({"--format", "Format"}, format, "NAME", "format of the output, if its ending does not determine it");
}

}  // namespace coastmesh
