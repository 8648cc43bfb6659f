#include "apps/cli/mesh_file.hpp"

#include "apps/usage/grid_usage.hpp"

namespace coastmesh {

void declareMeshFile(OptionTable& table, const std::string& name, const std::string& help, MeshFile& file) {
  table.argument(name, file.path, help);
  declareAssumedCrs(table, file.crs);
}

Grid readMeshFile(const MeshFile& file, Run& run, FileNotes notes) {
  return readMeshFile(
      file, [&run](const std::string& text) { run.warn(text); }, notes);
}

void warnOfCrs(const MeshFile& file, const std::string& why, Run& run) {
  if (!file.crs.empty()) run.warn("--assume-crs has no effect: " + why);
}

}  // namespace coastmesh
