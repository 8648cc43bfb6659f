#include "apps/edit/mesh_file.hpp"

#include <algorithm>
#include <vector>

#include "core/box_halves.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

Crs parseAssumed(const std::string& text) {
  try {
    return parseCrs(text);
  } catch (const InputError& error) {
    throw OptionError(std::string("--assume-crs: ") + error.what());
  }
}

void warnOfNotes(const MeshFile& file, const Grid& grid, const Warn& warn) {
  constexpr std::size_t kShown = 5;
  const std::size_t shown = std::min(kShown, grid.notes.size());
  for (std::size_t i = 0; i < shown; ++i) warn("'" + file.path + "': " + grid.notes[i]);
  if (shown < grid.notes.size())
    warn("'" + file.path + "': " + std::to_string(grid.notes.size() - shown) +
         " more inconsistencies; check with --target finds them");
}

// What is inconsistent in a model's file may stop the model. Other files, such as GIS layers, it does not read.
bool mayStopModels(const MeshFile& file) {
  const GridFormat* const format = gridFormatOf(file.path);
  return format != nullptr && format->says_depth;
}

// Files for models have no CRS, and models read degrees from many of them.
void warnOfDegrees(const MeshFile& file, const Grid& grid, const Warn& warn) {
  const GridFormat* const format = gridFormatOf(file.path);
  if (!file.crs.empty() || !grid.crs.isPlane() || format == nullptr) return;
  if (!format->says_depth && !format->lengths_in_metres) return;
  if (!mayBeDegrees(grid)) return;
  warn("'" + file.path +
       "' does not say its CRS, so coordinates are lengths in a plane; all lie within ±360, ±90: if they are "
       "degrees, give --assume-crs EPSG:4326, otherwise --assume-crs plane");
}

void warnOfOwnCrs(const MeshFile& file, const Grid& grid, const Crs& assumed, const Warn& warn) {
  if (!file.crs.empty() && !sameCrs(grid.crs, assumed))
    warn("--assume-crs has no effect: '" + file.path + "' says its CRS");
}

}  // namespace

bool mayBeDegrees(const Grid& grid) {
  constexpr double kNoLand = 3.0;  // to each side
  Bounds box;
  for (const Point& p : grid.nodes) box.add(p);
  const double west = box.low.x, south = box.low.y, east = box.high.x, north = box.high.y;
  if (west < -360.0 || east > 360.0 || south < -90.0 || north > 90.0) return false;
  const bool begins_at_origin = west == 0.0 && south == 0.0;
  return !begins_at_origin && std::max({-west, -south, east, north}) > kNoLand;
}

Grid readMeshFile(const MeshFile& file, const Warn& warn, FileNotes notes) {
  const Crs assumed = file.crs.empty() ? Crs{} : parseAssumed(file.crs);
  Grid grid = readGrid(file.path, assumed);
  if (grid.triangles.empty()) throw InputError("'" + file.path + "' holds no triangle");
  if (const std::string remark = remarkOnGrid(file.path); !remark.empty()) warn(remark);
  const bool may_stop = mayStopModels(file);
  if (notes == FileNotes::Warnings || !may_stop) warnOfNotes(file, grid, warn);
  if (!may_stop) grid.notes.clear();
  warnOfDegrees(file, grid, warn);
  warnOfOwnCrs(file, grid, assumed, warn);
  return grid;
}

void assumeCrs(Grid& grid, const MeshFile& file, const Warn& warn) {
  if (file.crs.empty()) return;
  const Crs assumed = parseAssumed(file.crs);
  if (grid.crs.isPlane() && !assumed.isPlane()) {
    grid.crs = assumed;
    grid.area_m2.clear();  // both were measured in the plane
    grid.min_angle_deg.clear();
  }
  warnOfOwnCrs(file, grid, assumed, warn);
}

std::string windingWarning(const Grid& grid, const ItemLoop& loop) {
  const std::vector<std::uint32_t> turned = turnedTriangles(grid, {}, loop);
  if (turned.empty()) return {};
  return std::to_string(turned.size()) + " of " + std::to_string(grid.triangles.size()) +
         forCount(grid.triangles.size(), " triangle", " triangles") +
         forCount(turned.size(), " is clockwise or flat", " are clockwise or flat") + ", the first at " +
         pointText(middleOf(grid, turned.front())) +
         ": most models reject this, and it makes shores islands and islands shores; --target turns clockwise "
         "triangles";
}

}  // namespace coastmesh
