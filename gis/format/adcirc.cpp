#include "gis/file/prj_file.hpp"
#include "gis/format/fort14_text.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/ibtype.hpp"

namespace coastmesh {
namespace {

// Writes ADCIRC's fort.14, depth positive down, and the CRS in a .prj beside it. Throws OutputError, also if a depth is
// unknown.
void writeAdcirc(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  TextWriter file(path);
  writeFort14(file, grid, grid.nodes, Fort14Kind::Adcirc, loop);
  file.close();
  writePrjBeside(path, grid.crs);
}

// Reads a fort.14; `notes` report what is wrong in it. Throws InputError.
Grid readAdcirc(const std::string& path, const Crs& unsaid) {
  Grid grid = readFort14(path, readPrjBeside(path, unsaid));
  for (Boundary& boundary : grid.boundaries) {
    if (isRolesOwn(boundary.ibtype)) boundary.ibtype = -1;
  }
  return grid;
}

}  // namespace

FormatRecord adcircFormat() {
  return {{.name = "adcirc",
           .endings = {".14", ".grd"},
           .description = "ADCIRC's fort.14, depth positive down",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Title, GridPart::Rivers, GridPart::Ibtypes, GridPart::Weirs, GridPart::BoundaryNames},
           .says_depth = true,
           .needs_depths = true,
           .places = NodePlaces::OneTurn,
           .lengths_in_metres = true},
          {writeAdcirc, readAdcirc, withPrjBeside}};
}

}  // namespace coastmesh
