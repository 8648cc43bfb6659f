#include "apps/mesh_file.hpp"

#include "gis/error.hpp"
#include "gis/grid_io.hpp"

namespace coastmesh {

void declareMeshFile(CommandLine& line, const std::string& name, const std::string& help, MeshFile& file) {
  line.argument(name, file.path, help);
  line.text("--assume-crs", file.crs, "CRS", "CRS of the mesh, where its file does not tell; none means a plane");
}

Grid readMeshFile(const MeshFile& file) {
  Grid grid = readGrid(file.path);
  if (grid.triangles.empty()) throw InputError("'" + file.path + "' holds no triangle");
  if (!file.crs.empty() && grid.crs.isPlane()) grid.crs = parseCrs(file.crs);
  return grid;
}

}  // namespace coastmesh
