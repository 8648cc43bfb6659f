#include "tests/fuzz/reader_cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "apps/cli/shard_file.hpp"
#include "apps/report/file_info.hpp"
#include "apps/usage/config_entries.hpp"
#include "apps/usage/config_file.hpp"
#include "apps/usage/mesh_usage.hpp"
#include "gis/clean/clean.hpp"
#include "gis/coast/group_features.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/poly_io.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/model/assign_boundaries.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/read/read_coastline.hpp"
#include "gis/size/size_features.hpp"

namespace coastmesh {

namespace {

void write(const std::string& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error("cannot write '" + path + "'");
}

// Longer inputs are only read: processing them would take long without a bug in any reader.
constexpr std::size_t kMostPoints = 2000;

void readMesh(const std::string& path) {
  Grid grid = readGrid(path, wgs84());
  requireConsistent(grid);
  if (grid.triangles.empty() || grid.nodes.size() > kMostPoints || grid.triangles.size() > kMostPoints) return;
  findMissingBoundaries(grid);
  requireConsistent(grid);
  try {
    toJson(describeMesh(grid));
  } catch (const InputError&) {  // a readable mesh may be impossible to measure; that error names no file
  }
}

void readAndClean(const std::string& path) {
  ReadReport read;
  const Coastline coastline = readCoastline(std::vector<std::string>{path}, read);
  if (read.points > kMostPoints) return;
  const auto groups = groupFeatures(coastline);
  CleanReport report;
  for (const auto& members : groups) {
    const Projection projection = Projection::fitted(coastline, members);
    cleanFeatures(coastline, members, projection, {}, report);
  }
}

void readPslg(const std::string& path) { readPoly(path); }

void readConfig(const std::string& path) {
  readConfigEntries(path);  // before the options are declared, which takes far longer
  MeshUsage usage;
  OptionTable table("mesh", "");
  declareMeshOptions(table, usage);
  std::vector<std::string> warnings;
  takeConfig(path, table, {"mesh", "clean", "check"}, warnings);
}

// Reads the positions of the groups, not their content, which a checksum protects. It is appended here.
void readShard(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  write(path, sealedShard({std::istreambuf_iterator<char>(file), {}}));
  GatheredShards({path});
}

void readBoundaries(const std::string& path) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  grid.triangles = {{0, 1, 2}, {0, 2, 3}};
  BoundaryOptions options;
  options.files = {path};
  assignBoundaries(grid, options);
  requireConsistent(grid);
}

void readSizes(const std::string& path) { readSizedFeatures(path, wgs84(), 0.1); }

void readRaster(const std::string& path) {
  constexpr std::int64_t kMostPixels = 64;
  const RasterBand band(path);
  const std::int64_t columns = std::min(band.columns(), kMostPixels), rows = std::min(band.rows(), kMostPixels);
  band.read({0, 0, columns, rows});
  band.read({band.columns() - columns, band.rows() - rows, columns, rows});
  const Point pixel = band.pixelOf(band.geometry().placeOf({0.5, 0.5}));
  if (std::abs(pixel.x) < 1e300 && !(std::abs(pixel.x - std::round(pixel.x)) <= 0.5)) throw std::logic_error("a pixel");
}

}  // namespace

const std::vector<ReaderCase>& readerCases() {
  static const std::vector<ReaderCase> cases{
      {"adcirc", {"f.14"}, readMesh},
      {"schism", {"f.gr3"}, readMesh},
      {"telemac", {"f.slf", "f.cli"}, readMesh},
      {"2dm", {"f.2dm"}, readMesh},
      {"mike", {"f.mesh"}, readMesh},
      {"gmsh", {"f.msh"}, readMesh},
      {"ugrid", {"f.nc"}, readMesh},
      {"mpas", {"f_mpas.nc"}, readMesh},
      {"vtu", {"f.vtu"}, readMesh},
      {"triangle", {"f.ele", "f.node", "f.poly"}, readMesh},
      {"poly", {"f.poly", "f.node"}, readPslg},
      {"fvcom", {"f_grd.dat", "f_dep.dat", "f_obc.dat", "f_cor.dat"}, readMesh},
      {"fesom", {"nod2d.out", "elem2d.out", "aux3d.out"}, readMesh},
      {"jigsaw", {"f_jigsaw.msh"}, readMesh},
      {"geojson_mesh", {"f.geojson", "f_nodes.geojson", "f_boundaries.geojson", "f_lines.geojson"}, readMesh},
      {"gpkg_mesh", {"f.gpkg"}, readMesh},
      {"geojson", {"f.geojson"}, readAndClean},
      {"cleaned_gpkg", {"f.gpkg"}, readAndClean},
      {"ldb", {"f.ldb"}, readAndClean},
      {"i2s", {"f.i2s"}, readAndClean},
      {"bln", {"f.bln"}, readAndClean},
      {"toml", {"f.toml"}, readConfig},
      {"json", {"f.json"}, readConfig},
      {"boundaries", {"f.geojson"}, readBoundaries},
      {"sizes", {"f.geojson"}, readSizes},
      {"raster", {"f.asc"}, readRaster},
      {"shard", {"f.shard"}, readShard},
  };
  return cases;
}

const ReaderCase& readerCase(std::string_view name) {
  const auto found = std::ranges::find(readerCases(), name, &ReaderCase::name);
  if (found == readerCases().end()) throw std::invalid_argument("there is no reader '" + std::string(name) + "'");
  return *found;
}

ReadOutcome runReader(const ReaderCase& reader, std::span<const std::uint8_t> bytes, const std::string& folder) {
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (std::size_t i = 0; i < reader.files.size(); ++i) {
    const std::size_t end = i + 1 < reader.files.size() ? rest.find(kNextFile) : std::string_view::npos;
    const std::string_view content = rest.substr(0, end);
    if (i == 0 || !content.empty()) write(folder + "/" + std::string(reader.files[i]), content);
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + kNextFile.size());
  }
  ReadOutcome outcome;
  try {
    reader.read(folder + "/" + std::string(reader.files.front()));
    outcome.read = true;
  } catch (const InputError& error) {
    outcome.refusal = error.what();
  } catch (const OptionError& error) {
    outcome.refusal = error.what();
  }
  // Libraries may have added files of their own.
  for (const auto& entry : std::filesystem::directory_iterator(folder)) std::filesystem::remove_all(entry);
  // Errors after cleaning name the feature's source file.
  const auto says = [&](std::string_view words) { return outcome.refusal.find(words) != std::string::npos; };
  if (!outcome.read && !says(folder) && !says(", feature ")) {
    throw std::logic_error("a refusal that names no file: " + outcome.refusal);
  }
  return outcome;
}

}  // namespace coastmesh
