#include "gis/format/grid_io.hpp"

#include <algorithm>
#include <cassert>
#include <filesystem>

#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_layers.hpp"
#include "gis/format/read_ogr_grid.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {
namespace {

const std::vector<FormatRecord>& records() {
  static const std::vector<FormatRecord> known = {
#define COASTMESH_FORMAT(name) name(),
      COASTMESH_GRID_FORMATS(COASTMESH_FORMAT)
#undef COASTMESH_FORMAT
  };
  return known;
}

// Formats with the ending of `path` that are recognised by content.
std::vector<const GridFormat*> formatsToldByContent(const std::string& path) {
  const std::string ending = lowerCase(std::filesystem::path(path).extension().string());
  std::vector<const GridFormat*> told;
  for (const GridFormat& format : gridFormats()) {
    const auto isOf = [&](std::string_view known) { return !ending.empty() && known.ends_with(ending); };
    if (functionsOf(format).holds != nullptr && std::ranges::any_of(format.endings, isOf)) told.push_back(&format);
  }
  return told;
}

std::string endingList(bool GridFormat::*able) {
  std::string list;
  for (const GridFormat& format : gridFormats()) {
    if (!(format.*able)) continue;
    for (const std::string_view ending : format.endings) {
      if (!list.empty()) list += ' ';
      list += ending;
    }
  }
  return list;
}

std::size_t edgesOfLines(const Grid& grid) {
  std::size_t edges = 0;
  for (const GridLine& line : grid.lines) edges += edgesOf(line).size();
  return edges;
}

// Files of other programs may have lines anywhere.
void keepLinesInside(Grid& grid) {
  const std::size_t before = edgesOfLines(grid);
  cutLinesOffEdges(grid);
  const std::size_t lost = before - edgesOfLines(grid);
  if (lost > 0)
    grid.notes.push_back(std::to_string(lost) +
                         forCount(lost, " edge of a line does not lie between two triangles and is left out",
                                  " edges of lines do not lie between two triangles and are left out"));
}

}  // namespace

const std::vector<GridFormat>& gridFormats() {
  static const std::vector<GridFormat> formats = [] {
    std::vector<GridFormat> all;
    for (const FormatRecord& record : records()) all.push_back(record.format);
    return all;
  }();
  return formats;
}

const GridFormat* formatByEnding(const std::string& path) {
  const std::string lower = lowerCase(path);
  const GridFormat* found = nullptr;
  std::size_t longest = 0;
  for (const GridFormat& format : gridFormats()) {
    for (const std::string_view ending : format.endings) {
      if (ending.size() <= longest || !lower.ends_with(ending)) continue;
      found = &format;
      longest = ending.size();
    }
  }
  return found;
}

const GridFormat& gridFormatFor(const std::string& path, const std::string& name) {
  if (name.empty()) {
    if (const GridFormat* format = formatByEnding(path)) return *format;
    throw OutputError("cannot tell the format of '" + path + "'; known endings are " +
                      endingList(&GridFormat::writable));
  }
  std::string names;
  for (const GridFormat& format : gridFormats()) {
    if (format.name == name) return format;
    names += ' ';
    names += format.name;
  }
  throw OutputError("there is no format '" + name + "'; known are" + names);
}

const FormatFunctions& functionsOf(const GridFormat& format) {
  const auto found =
      std::ranges::find(records(), format.name, [](const FormatRecord& record) { return record.format.name; });
  assert(found != records().end());
  return found->functions;
}

std::string withEnding(const std::string& path, const char* ending) {
  return std::filesystem::path(path).replace_extension(ending).string();
}

OutputFiles withPrjBeside(const std::string& path) { return {{path}, {}, prjBeside(path)}; }

OutputFiles layerFiles(const std::string& path) {
  return {
      {path, pathOfLayer(path, kNodeLayer), pathOfLayer(path, kBoundaryLayer), pathOfLayer(path, kLineLayer)}, {}, {}};
}

OutputFiles filesOf(const GridFormat& format, const std::string& path) {
  const FormatFunctions& functions = functionsOf(format);
  return functions.files ? functions.files(path) : OutputFiles{{path}, {}, {}};
}

// Programs use the same ending for different formats (.msh, .nc): the content decides.
const GridFormat* gridFormatOf(const std::string& path) {
  for (const GridFormat* const format : formatsToldByContent(path))
    if (functionsOf(*format).holds(path)) return format;
  return formatByEnding(path);
}

namespace {

// A pipe can be read only once, from start to end.
void requireNoPipe(const std::string& path) {
  std::error_code error;
  const GridFormat* const format = formatByEnding(path);
  if (format == nullptr || !std::filesystem::is_fifo(path, error)) return;
  if (formatsToldByContent(path).empty() && functionsOf(*format).read != readOgrGrid) return;
  throw InputError("'" + path + "' is a pipe; meshes of this format cannot be read from one, but from files");
}

}  // namespace

Grid readGrid(const std::string& path, const Crs& unsaid) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError("there is no file '" + path + "'");
  if (std::filesystem::is_directory(path, error)) throw InputError("'" + path + "' is a folder, no mesh");
  requireNoPipe(path);
  const GridFormat* const format = gridFormatOf(path);
  if (format == nullptr || !format->readable)
    throw InputError("cannot read '" + path + "' as a mesh; known endings are " + endingList(&GridFormat::readable));
  Grid grid = functionsOf(*format).read(path, unsaid);
  keepLinesInside(grid);
  requirePlaces(grid.nodes, grid.crs, path);
  return grid;
}

std::string remarkOnGrid(const std::string& path) {
  const GridFormat* const format = gridFormatOf(path);
  const auto remark = format != nullptr ? functionsOf(*format).remark : nullptr;
  return remark != nullptr ? remark(path) : std::string();
}

std::string openingsIn(const Grid& grid, const std::string& path, const GridFormat& format) {
  const auto openings = functionsOf(format).openings;
  return openings != nullptr ? openings(grid, path) : std::string();
}

}  // namespace coastmesh
