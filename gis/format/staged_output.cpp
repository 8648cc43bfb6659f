#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/one_turn.hpp"

namespace coastmesh {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToWrite(const std::string& path, const std::string& why) {
  throw OutputError("cannot write '" + path + "': " + why);
}

bool isThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

bool sameBytes(const fs::path& a, const fs::path& b) {
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return first && second && std::equal(Bytes(first), Bytes(), Bytes(second), Bytes());
}

bool hasShoresAcross(const Grid& grid) {
  return std::ranges::any_of(grid.boundaries, [](const Boundary& boundary) { return !boundary.back_nodes.empty(); });
}

const GridFormat& writable(const std::string& path, const GridFormat& format) {
  if (!format.writable) failToWrite(path, "the format " + std::string(format.name) + " can only be read");
  return format;
}

}  // namespace

StagedOutput::StagedOutput(const std::string& path, const GridFormat& format, bool overwrite)
    : format_(&writable(path, format)), files_(path, filesOf(format, path), overwrite) {}

// True if an existing .prj is kept, because it has the grid's CRS. Throws OutputError if it may not be replaced.
bool StagedOutput::keepsPrj(const Grid& grid) const {
  const std::string prj = filesOf(*format_, files_.path()).prj;
  if (prj.empty() || !isThere(prj)) return false;
  if (sameBytes(prj, fs::path(files_.stagingFolder()) / fs::path(prj).filename())) return true;
  try {
    if (sameCrs(readPrjBeside(prj), grid.crs)) return true;
  } catch (const InputError&) {
    // It cannot be read, so it is not the grid's CRS.
  }
  if (!files_.mayReplace()) throw OutputError("'" + prj + "' exists already; give --overwrite to replace it");
  const auto belongsTo = [&](const std::string& owner) {
    failToWrite(files_.path(), "'" + prj + "' belongs to '" + owner +
                                   "' and says another CRS than the mesh has; give the mesh another name");
  };
  const std::string shapefile = fs::path(prj).replace_extension(".shp").string();
  if (isThere(shapefile) && format_->name != "shp") belongsTo(shapefile);
  for (const std::string& input : inputs_) {
    for (const std::string& companion : companionsOf(input)) {
      std::error_code error;
      if (fs::equivalent(companion, prj, error)) belongsTo(input);
    }
  }
  return false;
}

void StagedOutput::write(const Grid& grid, const ItemLoop& loop) {
  if (grid.triangles.empty()) failToWrite(files_.path(), "the mesh has no triangles");
  requireConsistent(grid, loop);
  const auto make = [&](const Grid& made) {
    files_.make([&](const std::string& path) { functionsOf(*format_).write(made, path, loop); });
  };
  // A copy needs less memory than meshing did, and only meshes with a jump of longitudes or with weirs need one.
  std::optional<Grid> changed;
  const auto copy = [&]() -> Grid& { return changed ? *changed : changed.emplace(grid); };
  if (format_->places == NodePlaces::OneTurn && grid.crs.geographic)
    if (auto turned = inOneTurn(grid.nodes, grid.triangles, loop)) copy().nodes.assign(turned->begin(), turned->end());
  if (!format_->beside_grid && !format_->holds.has(GridPart::Weirs) && hasShoresAcross(grid))
    copy().boundaries = weirsAsShores(grid);
  make(changed ? *changed : grid);
  if (keepsPrj(grid)) files_.keep(filesOf(*format_, files_.path()).prj);
}

}  // namespace coastmesh
