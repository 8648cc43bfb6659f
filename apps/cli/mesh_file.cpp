#include "apps/cli/mesh_file.hpp"

#include <algorithm>

#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"

namespace coastmesh {

void declareMeshFile(OptionTable& table, const std::string& name, const std::string& help, MeshFile& file) {
  table.argument(name, file.path, help);
  table.section(Section::Input);
  table.text({"--assume-crs", "CRS of the mesh"}, file.crs, "CRS",
             "CRS of the mesh, if its file has none; default: a plane");
}

namespace {

Crs parseAssumed(const std::string& text) {
  try {
    return parseCrs(text);
  } catch (const InputError& error) {
    throw OptionError(std::string("--assume-crs: ") + error.what());
  }
}

void warnOfNotes(const MeshFile& file, const Grid& grid, Run& run) {
  constexpr std::size_t kShown = 5;
  const std::size_t shown = std::min(kShown, grid.notes.size());
  for (std::size_t i = 0; i < shown; ++i) run.warn("'" + file.path + "': " + grid.notes[i]);
  if (shown < grid.notes.size())
    run.warn("'" + file.path + "': " + std::to_string(grid.notes.size() - shown) +
             " more inconsistencies; check with --target finds them");
}

}  // namespace

Grid readMeshFile(const MeshFile& file, Run& run, FileNotes notes) {
  const Crs assumed = file.crs.empty() ? Crs{} : parseAssumed(file.crs);
  Grid grid = readGrid(file.path, assumed);
  if (grid.triangles.empty()) throw InputError("'" + file.path + "' holds no triangle");
  if (const std::string remark = remarkOnGrid(file.path); !remark.empty()) run.warn(remark);
  if (notes == FileNotes::Warnings) warnOfNotes(file, grid, run);
  if (!file.crs.empty() && !sameCrs(grid.crs, assumed)) warnOfCrs(file, "'" + file.path + "' says its CRS", run);
  return grid;
}

void warnOfCrs(const MeshFile& file, const std::string& why, Run& run) {
  if (!file.crs.empty()) run.warn("--assume-crs has no effect: " + why);
}

}  // namespace coastmesh
