#include <cstdint>
#include <filesystem>
#include <vector>

#include "gis/fields/fort13.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/ibtype.hpp"
#include "gis/model_format/fort14_text.hpp"

namespace coastmesh {
namespace {

// fort.14 has its fort.13.
std::string attributesBeside(const std::string& path) { return withEnding(path, ".13"); }

// Writes ADCIRC's fort.14, depth positive down, nodal attributes in a fort.13 beside it, and the CRS in a .prj. Throws
// OutputError, also if a depth or an attribute is unknown.
void writeAdcirc(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  requireFields(grid, attributesBeside(path));
  TextWriter file(path);
  writeFort14(file, grid, grid.nodes, Fort14Kind::Adcirc, loop);
  file.close();
  if (!grid.node_fields.empty()) writeFort13(attributesBeside(path), grid, loop);
  writePrjBeside(path, grid.crs);
}

// Reads a fort.14, and the fort.13 beside it if there is one; `notes` report what is wrong in them. Throws InputError.
Grid readAdcirc(const std::string& path, const Crs& unsaid) {
  std::vector<std::int64_t> ids;
  Grid grid = readFort14(path, readPrjBeside(path, unsaid), &ids);
  if (std::filesystem::exists(attributesBeside(path))) readFort13(attributesBeside(path), ids, grid);
  for (Boundary& boundary : grid.boundaries) {
    if (isRolesOwn(boundary.ibtype)) boundary.ibtype = -1;
  }
  return grid;
}

}  // namespace

FormatRecord adcircFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    return {{path, attributesBeside(path)}, {}, prjBeside(path)};
  };
  return {{.name = "adcirc",
           .endings = {".14", ".grd"},
           .description = "ADCIRC's fort.14, depth positive down, and fort.13",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Title, GridPart::Rivers, GridPart::Ibtypes, GridPart::Weirs, GridPart::BoundaryNames,
                     GridPart::NodeFields},
           .says_depth = true,
           .needs_depths = true,
           .places = NodePlaces::OneTurn,
           .lengths_in_metres = true},
          {.write = writeAdcirc, .read = readAdcirc, .files = files, .openings = openRingsText}};
}

}  // namespace coastmesh
