#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include "gis/error.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/one_turn.hpp"
#include "gis/lower_case.hpp"
#include "gis/model_format/fort14_text.hpp"

namespace coastmesh {
namespace {

// The file of a nodal attribute: manning.gr3 beside hgrid.gr3, as SCHISM looks for it; lake_manning.gr3 beside a
// lake.gr3.
std::string pathOfField(const std::string& path, const std::string& word) {
  const std::filesystem::path beside(path);
  const std::string stem = beside.stem().string();
  return (beside.parent_path() / ((stem == "hgrid" ? word : stem + '_' + word) + ".gr3")).string();
}

// The files of friction that SCHISM knows, and that of flood plains, which is for edits of the mesh. SCHISM has many
// others, of which most are no attributes of the mesh.
constexpr std::array<const char*, 4> kFields{"manning", "drag", "rough", "flood_plain"};

void readFields(const std::string& path, Grid& grid) {
  for (const char* const word : kFields) {
    const std::string beside = pathOfField(path, word);
    if (!std::filesystem::exists(beside)) continue;
    const FieldName& known = *findFieldName(word);
    NodeField& field = grid.node_fields.emplace_back(NodeField{std::string(known.name), std::string(known.unit)});
    field.values = readGr3Values(beside, grid);
  }
}

// Writes SCHISM's hgrid.gr3 in the grid's CRS, hgrid.ll beside it in longitudes and latitudes (not for a plane), and
// the CRS in a .prj; depth positive down. Nodal attributes have a file each. `path` may name either file of the mesh.
// Throws OutputError, also if a depth or an attribute is unknown.
void writeSchism(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  requireFields(grid, path);
  if (grid.crs.isPlane() && path.ends_with(".ll"))
    throw OutputError(
        "cannot write '" + path +
        "': it holds longitudes and latitudes, and the mesh lies in a plane; write a .gr3, or say its CRS "
        "with --crs");
  TextWriter gr3(withEnding(path, ".gr3"));
  writeFort14(gr3, grid, grid.nodes, Fort14Kind::Schism, loop);
  gr3.close();
  for (const NodeField& field : grid.node_fields) {
    TextWriter values(pathOfField(path, wordOf(field)));
    writeGr3Values(values, grid, field.values, loop);
    values.close();
  }
  if (grid.crs.isPlane()) return;
  TextWriter ll(withEnding(path, ".ll"));
  std::vector<Point> places = geographicNodes(grid, loop);
  // `StagedOutput` does this for geographic grids only; these may come from a projected one.
  if (auto turned = inOneTurn(places, grid.triangles, loop)) places = *std::move(turned);
  writeFort14(ll, grid, places, Fort14Kind::Schism, loop);
  ll.close();
  writePrjBeside(path, grid.crs);
}

// Reads either file, and those of friction beside it. A .ll is in WGS 84, unless `unsaid` has other longitudes: the
// .prj is that of the .gr3. Throws InputError.
Grid readSchism(const std::string& path, const Crs& unsaid) {
  const bool degrees = lowerCase(std::filesystem::path(path).extension().string()) == ".ll";
  Grid grid = readFort14(path, degrees ? (unsaid.geographic ? unsaid : wgs84()) : readPrjBeside(path, unsaid));
  for (Boundary& boundary : grid.boundaries) boundary.ibtype = -1;  // SCHISM only distinguishes land and islands
  readFields(path, grid);
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
           .holds = {GridPart::Title, GridPart::Quads, GridPart::BoundaryNames, GridPart::NodeFields},
           .says_depth = true,
           .needs_depths = true,
           .places = NodePlaces::OneTurn,
           .lengths_in_metres = true},
          {.write = writeSchism, .read = readSchism, .files = files, .openings = openRingsText}};
}

}  // namespace coastmesh
