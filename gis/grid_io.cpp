#include "gis/grid_io.hpp"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <filesystem>

#include "gis/error.hpp"
#include "gis/grid_formats.hpp"
#include "gis/grid_layers.hpp"
#include "gis/prj_file.hpp"
#include "gis/read_2dm.hpp"
#include "gis/read_gmsh.hpp"
#include "gis/read_ogr_grid.hpp"
#include "gis/read_triangle.hpp"
#include "gis/read_ugrid.hpp"
#include "gis/write_2dm.hpp"
#include "gis/write_geojson.hpp"
#include "gis/write_gmsh.hpp"
#include "gis/write_ogr.hpp"
#include "gis/write_triangle.hpp"
#include "gis/write_ugrid.hpp"
#include "gis/write_vtu.hpp"

namespace coastmesh {
namespace {

std::string withEnding(const std::string& path, const char* ending) {
  return std::filesystem::path(path).replace_extension(ending).string();
}

OutputFiles withPrj(const std::string& path) { return {{path}, {}, prjBeside(path)}; }

OutputFiles triangleFiles(const std::string& path) {
  return {{withEnding(path, ".node"), withEnding(path, ".ele"), withEnding(path, ".poly")}, {}, prjBeside(path)};
}

// SQLite would play a log that an older file of the name left into the new one.
OutputFiles geoPackageFiles(const std::string& path) {
  return {{path}, {path + "-wal", path + "-shm", path + "-journal"}, {}};
}

OutputFiles layerFiles(const std::string& path) {
  return {{path, pathOfLayer(path, kNodeLayer), pathOfLayer(path, kBoundaryLayer)}, {}, {}};
}

OutputFiles shapefileFiles(const std::string& path) {
  OutputFiles files;
  for (const std::string& layer : layerFiles(path).targets) {
    for (const char* ending : {".shp", ".shx", ".dbf", ".cpg"}) files.targets.push_back(withEnding(layer, ending));
    for (const char* ending : {".prj", ".qix", ".qpj", ".sbn", ".sbx", ".fbn", ".fbx", ".ain", ".aih", ".atx", ".ixs",
                               ".mxs", ".idm", ".ind", ".cst", ".shp.xml"})
      files.stale.push_back(withEnding(layer, ending));
  }
  files.prj = prjBeside(path);
  return files;
}

struct Record {
  GridFormat format;
  FormatFunctions functions;
};

const std::vector<Record>& records() {
  static const std::vector<Record> known = {
      {{"gpkg", {".gpkg"}, "GeoPackage with layers of triangles, nodes and boundaries", true, true},
       {writeGeoPackage, readOgrGrid, geoPackageFiles}},
      {{"geojson", {".geojson", ".json"}, "GeoJSON, three files", true, true}, {writeGeoJson, readOgrGrid, layerFiles}},
      {{"shp", {".shp"}, "Shapefile, three sets of files", true, true}, {writeShapefile, readOgrGrid, shapefileFiles}},
      {{"fgb", {".fgb"}, "FlatGeobuf, three files", true, true}, {writeFlatGeobuf, readOgrGrid, layerFiles}},
      {{"ugrid", {".nc"}, "UGRID NetCDF for QGIS, xugrid and D-FlowFM", true, true}, {writeUgrid, readUgrid, nullptr}},
      {{"2dm", {".2dm"}, "SMS 2dm for QGIS and TUFLOW, z positive up", true, true}, {write2dm, read2dm, withPrj}},
      {{"gmsh", {".msh"}, "Gmsh 4.1 for Thetis, Firedrake, SLIM and FEniCS", true, true},
       {writeGmsh, readGmsh, withPrj}},
      {{"gmsh22", {}, "Gmsh 2.2", true, true}, {writeGmsh22, readGmsh, withPrj}},
      {{"triangle", {".node", ".ele"}, "Triangle's .node, .ele and .poly", true, true},
       {writeTriangle, readTriangle, triangleFiles}},
      {{"vtu", {".vtu"}, "VTK unstructured grid for ParaView", false, true}, {writeVtu, nullptr, nullptr}},
  };
  return known;
}

const GridFormat* formatByEnding(const std::string& path) {
  std::string lower = path;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const GridFormat& format : gridFormats())
    for (const std::string_view ending : format.endings)
      if (lower.ends_with(ending)) return &format;
  return nullptr;
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

}  // namespace

const std::vector<GridFormat>& gridFormats() {
  static const std::vector<GridFormat> formats = [] {
    std::vector<GridFormat> all;
    for (const Record& record : records()) all.push_back(record.format);
    return all;
  }();
  return formats;
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
  const auto found = std::ranges::find(records(), format.name, [](const Record& record) { return record.format.name; });
  assert(found != records().end());
  return found->functions;
}

OutputFiles filesOf(const GridFormat& format, const std::string& path) {
  const FormatFunctions& functions = functionsOf(format);
  return functions.files ? functions.files(path) : OutputFiles{{path}, {}, {}};
}

Grid readGrid(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError("there is no file '" + path + "'");
  if (std::filesystem::is_directory(path, error)) throw InputError("'" + path + "' is a folder, no mesh");
  const GridFormat* const format = formatByEnding(path);
  if (format == nullptr || !format->readable)
    throw InputError("cannot read '" + path + "' as a mesh; known endings are " + endingList(&GridFormat::readable));
  return functionsOf(*format).read(path);
}

}  // namespace coastmesh
