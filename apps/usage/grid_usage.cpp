#include "apps/usage/grid_usage.hpp"

#include "gis/format/grid_io.hpp"

namespace coastmesh {

void declareGridOutputs(OptionTable& table, std::vector<std::string>& outputs, std::string& format) {
  const auto files = [&format](const std::string& path) { return filesOf(gridFormatFor(path, format), path); };
  table.outputs("-o,--output", outputs, {.required = true, .files = files}, "mesh to write; repeat it for several");
  table.text("--format", format, "NAME", "format of the output, where its ending does not say");
}

}  // namespace coastmesh
