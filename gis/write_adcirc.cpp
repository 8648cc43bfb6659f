#include "gis/write_adcirc.hpp"

#include "gis/fort14_text.hpp"
#include "gis/grid_formats.hpp"
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
    const bool own = boundary.ibtype == 20 || boundary.ibtype == 21 || boundary.ibtype == 22;
    if (own) boundary.ibtype = -1;
  }
  grid.crs = readPrjBeside(path);
  return grid;
}

FormatRecord adcircFormat() {
  return {{"adcirc", {".14", ".grd"}, "ADCIRC's fort.14, depth positive down", true, true, true},
          {writeAdcirc, readAdcirc, withPrjBeside}};
}

}  // namespace coastmesh
