#include "apps/job/idle_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "gis/coast/feature_bounds.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/for_count.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/model/depth.hpp"
#include "gis/places.hpp"
#include "gis/raster/raster_turn.hpp"

namespace coastmesh {

namespace {

bool coversAny(const RasterGeometry& file, const Grid& grid) {
  const RasterGeometry raster = asSeenFrom(grid.crs, file);
  const bool as_is = grid.crs.isPlane() || raster.crs.isPlane() || sameCrs(grid.crs, raster.crs);
  std::optional<CrsMap> map;
  if (!as_is) map.emplace(toOgr(grid.crs), toOgr(raster.crs));
  return std::ranges::any_of(grid.nodes, [&](const Point& node) {
    const Point pixel = raster.pixelOf(map ? map->forward(node) : node);
    return pixel.x >= 0.0 && pixel.x <= raster.columns && pixel.y >= 0.0 && pixel.y <= raster.rows;
  });
}

Box boxOf(const SizedFeatures::Part& part) {
  Box box;
  for (const Polygon& polygon : part.polygons)
    for (const Point& p : polygon.outer) box.add(p);
  for (const auto& line : part.lines)
    for (const Point& p : line) box.add(p);
  return box;
}

Box boxOf(const ShoreLine& line) {
  Box box;
  for (const Point& p : line.points) box.add(p);
  return box;
}

// With a margin: sizes grow from features outside the mesh into it, and closed straits are not part of it.
Box surroundingsOf(const Grid& grid) {
  Box mesh;
  for (const Point& node : grid.nodes) mesh.add(node);
  return mesh.grownBy(0.5 * std::max(mesh.xmax - mesh.xmin, mesh.ymax - mesh.ymin));
}

// Names that the mesh has of features of that use: of lines, or of regions.
std::set<std::string> namesIn(const MeshJobResult& result, FeatureUse use) {
  const Grid& grid = result.grid;
  std::set<std::string> names;
  if (use == FeatureUse::Region) {
    for (const GridFeature& feature : grid.features) names.insert(feature.region);
  } else {
    const LineKind kind = use == FeatureUse::Weir ? LineKind::Weir : LineKind::Constraint;
    for (const GridLine& line : grid.lines)
      if (line.kind == kind) names.insert(line.name);
    const std::vector<std::string>& opened = result.finish.weirs.names;
    if (use == FeatureUse::Weir) names.insert(opened.begin(), opened.end());
  }
  return names;
}

// True if the feature was read from that file, or from its layer if the name has one: "file|layername=layer".
bool isFrom(const Feature& feature, const std::string& named) {
  if (feature.source == named || feature.source.starts_with(named + "|")) return true;
  const std::size_t bar = named.rfind('|');
  if (bar == std::string::npos) return false;
  const std::string file = named.substr(0, bar);
  constexpr std::string_view kLayer = "layername=";
  const std::string layer = named.substr(bar + 1);
  return feature.source == file ||
         feature.source == file + "|" + (layer.starts_with(kLayer) ? layer.substr(kLayer.size()) : layer);
}

// How many points of each feature lie outside the water.
std::map<std::uint32_t, std::size_t> lostPoints(const MeshJobResult& result) {
  std::map<std::uint32_t, std::size_t> lost;
  for (const Edit& edit : result.edit_places)
    if (edit.kind == EditKind::OutsideWater) ++lost[edit.feature];
  return lost;
}

// The files of that use that left nothing in the mesh; features beyond the frame were removed before.
std::vector<std::string> idleFiles(const Coastline& coastline, FeatureUse use, const std::vector<std::string>& files,
                                   const MeshJobResult& result) {
  if (files.empty()) return {};
  const std::set<std::string> names = namesIn(result, use);
  const std::map<std::uint32_t, std::size_t> lost = lostPoints(result);
  std::vector<std::string> idle;
  for (const std::string& file : files) {
    if (file == "-" || file == "/dev/stdin") continue;
    bool is_used = false;
    for (std::uint32_t f = 0; f < coastline.features.size() && !is_used; ++f) {
      const Feature& feature = coastline.features[f];
      if (feature.use != use || !isFrom(feature, file)) continue;
      const bool left_any = result.took_part.contains(f) && names.contains(lineNameOf(feature));
      const auto outside = lost.find(f);
      is_used = left_any || feature.points.size() > (outside == lost.end() ? 0 : outside->second);
    }
    if (!is_used) idle.push_back(file);
  }
  return idle;
}

bool holdsPolygons(const Coastline& coastline, FeatureUse use, const std::string& file) {
  return std::ranges::any_of(coastline.features, [&](const Feature& feature) {
    return feature.use == use && !feature.polygons.empty() && isFrom(feature, file);
  });
}

// True iff the file holds polygons and nothing else.
bool holdsOnlyPolygons(const Coastline& coastline, FeatureUse use, const std::string& file) {
  if (use == FeatureUse::Region || !holdsPolygons(coastline, use, file)) return false;
  return std::ranges::none_of(coastline.features, [&](const Feature& feature) {
    return feature.use == use && !(feature.lines.empty() && feature.points.empty()) && isFrom(feature, file);
  });
}

// The depths that places in a triangle may have. A node at `least_m` may have been lowered to it from any smaller
// depth.
struct DepthRange {
  double from_m = std::numeric_limits<double>::infinity(), to_m = -from_m;

  void add(double depth_m, double least_m) {
    from_m = std::min(from_m, depth_m > least_m ? depth_m : -std::numeric_limits<double>::infinity());
    to_m = std::max(to_m, depth_m);
  }
  bool meets(const DepthBand& band) const { return to_m >= band.from_m && from_m < band.to_m; }
};

// Bands that do not meet the range of depths in any triangle. Pixels outside the water, which may lie in them, can make
// sizes beside them smaller all the same.
void addIdleBands(const MeshJob& job, const Grid& grid, std::vector<std::string>& warnings) {
  std::vector<DepthBand> idle = job.sizes.depth.bands;
  for (const auto& triangle : grid.triangles) {
    if (idle.empty()) return;
    DepthRange depths;
    for (const std::uint32_t v : triangle)
      if (std::isfinite(grid.z[v])) depths.add(-grid.z[v], job.finish.depth.min_depth_m);
    std::erase_if(idle, [&](const DepthBand& band) { return depths.meets(band); });
  }
  for (const DepthBand& band : idle) {
    std::ostringstream text;
    text << "no depth of the mesh lies in --depth-band " << band.from_m << ',' << band.to_m << ',' << band.size_m
         << ": at most it has an effect beside pixels outside the water";
    warnings.push_back(text.str());
  }
}

constexpr const char* kCrsRight = "; is its CRS right?";

// Counts features and names the first few, by name or number, with a place.
class NamedFeatures {
 public:
  void add(const Feature& feature, const Point& place) {
    if (++count_ > kMostNamed) return;
    const std::string name(nameOf(feature.attributes));
    text_ += (text_.empty() ? "" : ", ") +
             (name.empty() ? "feature " + std::to_string(feature.fid) : "'" + name + "'") + " at " + pointText(place);
  }
  std::size_t count() const { return count_; }
  std::string text() const { return text_ + (count_ > kMostNamed ? " and more" : ""); }

 private:
  static constexpr std::size_t kMostNamed = 5;
  std::size_t count_ = 0;
  std::string text_;
};

}  // namespace

std::vector<std::string> warningsOfPolygons(const InputOptions& input, const Coastline& coastline) {
  std::vector<std::string> all;
  const auto addPolygons = [&](const std::string& option, const std::vector<std::string>& files, FeatureUse use,
                               const std::string& kept) {
    for (const std::string& file : files)
      if (holdsPolygons(coastline, use, file))
        all.push_back(option + " " + file + ": its polygons are left out: only " + kept +
                      " count; --regions takes polygons, whose borders become edges");
  };
  addPolygons("--constraints", input.constraints, FeatureUse::Constraint, "lines and points");
  addPolygons("--weirs", input.weirs, FeatureUse::Weir, "lines");
  return all;
}

void leaveOutPolygonFiles(InputOptions& input, const Coastline& coastline) {
  const auto leaveOut = [&](std::vector<std::string>& files, FeatureUse use) {
    std::erase_if(files, [&](const std::string& file) { return holdsOnlyPolygons(coastline, use, file); });
  };
  leaveOut(input.constraints, FeatureUse::Constraint);
  leaveOut(input.weirs, FeatureUse::Weir);
}

void addStrayPoints(const JobInput& input, MeshJobResult& result) {
  const std::vector<Feature>& features = input.coastline().features;
  std::vector<std::uint8_t> in_group(features.size(), 0);
  for (std::size_t group = 0; group < input.groups(); ++group)
    for (const std::size_t member : input.members(group)) in_group[member] = 1;
  for (std::uint32_t f = 0; f < features.size(); ++f) {
    if (in_group[f] != 0 || features[f].use != FeatureUse::Constraint) continue;
    for (const Point& point : features[f].points) {
      result.edit_places.push_back({EditKind::OutsideWater, point, features[f].fid, f});
      result.edited.try_emplace(f, features[f].source);
      ++result.edits[static_cast<std::size_t>(EditKind::OutsideWater)];
    }
  }
}

std::vector<std::string> warningsOfLostPoints(const InputOptions& input, const Coastline& coastline,
                                              const MeshJobResult& result) {
  std::vector<std::string> all;
  const std::vector<std::string> idle = idleFiles(coastline, FeatureUse::Constraint, input.constraints, result);
  for (const std::string& file : input.constraints) {
    if (std::ranges::find(idle, file) != idle.end()) continue;
    NamedFeatures lost;
    for (const Edit& edit : result.edit_places) {
      const Feature& feature = coastline.features[edit.feature];
      if (edit.kind == EditKind::OutsideWater && isFrom(feature, file)) lost.add(feature, edit.place);
    }
    if (lost.count() == 0) continue;
    all.push_back("--constraints " + file + ": " + std::to_string(lost.count()) +
                  forCount(lost.count(), " point lies outside the water, and is no vertex: ",
                           " points lie outside the water, and are no vertices: ") +
                  lost.text());
  }
  return all;
}

std::vector<std::string> notesOfLostWeirs(const InputOptions& input, const Coastline& coastline,
                                          const MeshJobResult& result) {
  std::vector<std::string> all;
  const std::vector<std::string> idle = idleFiles(coastline, FeatureUse::Weir, input.weirs, result);
  for (const std::string& file : input.weirs) {
    if (std::ranges::find(idle, file) != idle.end()) continue;
    NamedFeatures lost;
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < coastline.features.size(); ++f) {
      const Feature& feature = coastline.features[f];
      if (feature.use != FeatureUse::Weir || feature.lines.empty() || !isFrom(feature, file)) continue;
      ++count;
      const auto& line = feature.lines.front();
      if (!result.took_part.contains(f)) lost.add(feature, line[line.size() / 2]);
    }
    if (lost.count() == 0) continue;
    all.push_back("--weirs " + file + ": " + std::to_string(lost.count()) + " of " + std::to_string(count) +
                  forCount(lost.count(), " weirs lies outside of the mesh: ", " weirs lie outside of the mesh: ") +
                  lost.text());
  }
  return all;
}

std::vector<std::string> warningsOfIdleInputs(const MeshJob& job, const SizeInputs& sizes, const Coastline& coastline,
                                              const MeshJobResult& result) {
  const Grid& grid = result.grid;
  std::vector<std::string> all;
  if (grid.triangles.empty()) return all;
  for (const RasterGeometry& raster : sizes.rasters)
    if (!coversAny(raster, grid))
      all.push_back("--size-raster " + raster.path + ": no node of the mesh lies in it; is its CRS right?");
  if (hasDepths(grid)) addIdleBands(job, grid, all);
  const bool any = !sizes.layers->features.empty() || !job.sizes.passages.empty() || !job.sizes.barriers.empty();
  const Box around = any ? surroundingsOf(grid) : Box{};  // visits every node
  const auto isNear = [&](const auto& part) { return meetAtAnyTurn(boxOf(part), around, grid.crs); };
  for (std::size_t file = 0; file < sizes.layers->features.size(); ++file)
    if (std::ranges::none_of(sizes.layers->features[file].parts, isNear))
      all.push_back("--size-features " + job.sizes.features[file] +
                    ": none of them lies in the mesh, or near it; is its CRS right?");
  const auto addGuides = [&](const std::string& option, const std::vector<std::string>& files,
                             const std::vector<ShoreLine>& lines) {
    for (std::size_t file = 0; file < files.size(); ++file)
      if (std::ranges::none_of(lines, [&](const ShoreLine& line) { return line.file == file && isNear(line); }))
        all.push_back(option + " " + files[file] + ": no line of it lies in the mesh, or near it; is its CRS right?");
  };
  addGuides("--passages", job.sizes.passages, sizes.layers->passages);
  addGuides("--barriers", job.sizes.barriers, sizes.layers->barriers);
  const auto addIdle = [&](const std::string& option, const std::vector<std::string>& files, FeatureUse use,
                           const std::string& text) {
    for (const std::string& file : idleFiles(coastline, use, files, result))
      if (!holdsOnlyPolygons(coastline, use, file)) all.push_back(option + " " + file + ": " + text + kCrsRight);
  };
  addIdle("--constraints", job.input.constraints, FeatureUse::Constraint, "nothing of it lies in the water");
  addIdle("--weirs", job.input.weirs, FeatureUse::Weir, "no line of it lies in the water that is meshed");
  addIdle("--regions", job.input.regions, FeatureUse::Region, "no polygon of it holds any of the mesh");
  return all;
}

}  // namespace coastmesh
