#include "gis/write_adcirc.hpp"

#include "gis/fort14_text.hpp"
#include "gis/grid_formats.hpp"
#include "gis/ibtype.hpp"
#include "gis/prj_file.hpp"

namespace coastmesh {

void writeAdcirc(const Grid& grid, const std::string& path) {
  requireZ(grid, path);
  TextWriter file(path);
  writeFort14(file, grid, grid.nodes, Fort14Kind::Adcirc);
  file.close();
  writePrjBeside(path, grid.crs);
}

Grid readAdcirc(const std::string& path) {
  Grid grid = readFort14(path);
  for (Boundary& boundary : grid.boundaries) {
    if (isRolesOwn(boundary.ibtype)) boundary.ibtype = -1;
  }
  grid.crs = readPrjBeside(path);
  return grid;
}

FormatRecord adcircFormat() {
  return {{"adcirc",
           {".14", ".grd"},
           "ADCIRC's fort.14, depth positive down",
           true,
           true,
           {GridPart::Title, GridPart::Rivers, GridPart::Ibtypes, GridPart::Weirs},
           true},
          {writeAdcirc, readAdcirc, withPrjBeside}};
}

}  // namespace coastmesh
