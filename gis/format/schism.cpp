#include <algorithm>
#include <filesystem>

#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/format/fort14_text.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/one_turn.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {
namespace {

// Writes SCHISM's hgrid.gr3 in the grid's CRS, hgrid.ll beside it in longitudes and latitudes (not for a plane), and
// the CRS in a .prj; depth positive down. `path` may name either file. Throws OutputError, also if a depth is unknown.
void writeSchism(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  if (grid.crs.isPlane() && path.ends_with(".ll"))
    throw OutputError(
        "cannot write '" + path +
        "': it holds longitudes and latitudes, and the mesh lies in a plane; write a .gr3, or say its CRS "
        "with --crs");
  TextWriter gr3(withEnding(path, ".gr3"));
  writeFort14(gr3, grid, grid.nodes, Fort14Kind::Schism, loop);
  gr3.close();
  if (grid.crs.isPlane()) return;
  TextWriter ll(withEnding(path, ".ll"));
  std::vector<Point> places = geographicNodes(grid, loop);
  // `StagedOutput` does this for geographic grids only; these may come from a projected one.
  if (auto turned = inOneTurn(places, grid.triangles, loop)) places = *std::move(turned);
  writeFort14(ll, grid, places, Fort14Kind::Schism, loop);
  ll.close();
  writePrjBeside(path, grid.crs);
}

// Reads either file. A .ll is in WGS 84, unless `unsaid` has other longitudes: the .prj is that of the .gr3. Throws
// InputError.
Grid readSchism(const std::string& path, const Crs& unsaid) {
  const bool degrees = lowerCase(std::filesystem::path(path).extension().string()) == ".ll";
  Grid grid = readFort14(path, degrees ? (unsaid.geographic ? unsaid : wgs84()) : readPrjBeside(path, unsaid));
  for (Boundary& boundary : grid.boundaries) boundary.ibtype = -1;  // SCHISM only distinguishes land and islands
  return grid;
}

}  // namespace

FormatRecord schismFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    return {{withEnding(path, ".gr3"), withEnding(path, ".ll")}, {}, prjBeside(path)};
  };
  return {{.name = "schism",
           .endings = {".gr3", ".ll"},
           .description = "SCHISM's hgrid.gr3 and hgrid.ll, depth positive down",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Title, GridPart::Quads, GridPart::BoundaryNames},
           .says_depth = true,
           .needs_depths = true,
           .places = NodePlaces::OneTurn,
           .lengths_in_metres = true},
          {writeSchism, readSchism, files}};
}

}  // namespace coastmesh
