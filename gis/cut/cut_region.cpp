#include "gis/cut/cut_region.hpp"

#include <iterator>
#include <utility>

#include "gis/coast/input_polygons.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/read/read_coastline.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 360.0;

bool isIn(const Box& box, const Point& p) {
  return box.xmin <= p.x && p.x <= box.xmax && box.ymin <= p.y && p.y <= box.ymax;
}

// The box with its east beyond its west.
Box boxOf(const CutRegion& region, const Crs& crs) {
  Box box = *region.box;
  if (box.xmin < box.xmax) return box;
  if (!crs.geographic)
    throw InputError("the box ends west of where it begins, which only degrees allow: the mesh is in " + nameOf(crs));
  box.xmax += kTurn;
  return box;
}

// The polygons of a file, in their own CRS.
class FilePolygons {
 public:
  FilePolygons(const std::string& path, const Crs& crs, std::vector<std::string>& warnings)
      : FilePolygons(polygonsOf(path, crs, warnings), crs) {}

  // Sets `holds[i]` for each place that is in a polygon; the places are brought to the polygons' CRS.
  void markHeld(std::vector<double>& x, std::vector<double>& y, std::vector<std::uint8_t>& holds) const {
    if (map_) map_->forward(x, y);
    for (std::size_t i = 0; i < holds.size(); ++i) polygons_.visit({x[i], y[i]}, [&](std::uint32_t) { holds[i] = 1; });
  }

 private:
  FilePolygons(const Coastline& coastline, const Crs& crs)
      : polygons_(searchable(coastline, crs), coastline.crs.geographic && !crs.isPlane()) {
    if (!crs.isPlane() && !coastline.crs.isPlane() && !sameCrs(crs, coastline.crs))
      map_.emplace(toOgr(crs), toOgr(coastline.crs));
  }

  static Coastline polygonsOf(const std::string& path, const Crs& crs, std::vector<std::string>& warnings) {
    ReadReport report;
    Coastline coastline = readCoastline({{path, FeatureUse::Frame}}, {}, report);
    // What is assumed of a file without a CRS does not matter for a grid in a plane.
    if (!crs.isPlane()) std::ranges::move(report.warnings, std::back_inserter(warnings));
    return coastline;
  }

  static std::vector<InputPolygons> searchable(const Coastline& coastline, const Crs& crs) {
    std::vector<InputPolygons> polygons;
    for (const Feature& feature : coastline.features)
      polygons.emplace_back(feature.polygons, coastline.crs.geographic && !crs.isPlane());
    return polygons;
  }

  PolygonsByPlace polygons_;
  std::optional<CrsMap> map_;
};

std::vector<FilePolygons> polygonsOfFiles(const std::vector<std::string>& paths, const Crs& crs,
                                          std::vector<std::string>& warnings) {
  std::vector<FilePolygons> files;
  for (const std::string& path : paths) files.emplace_back(path, crs, warnings);
  return files;
}

// Which of some places are in a polygon of any file.
std::vector<std::uint8_t> heldPlaces(const std::vector<FilePolygons>& files, const std::vector<Point>& places) {
  std::vector<std::uint8_t> held(places.size(), 0);
  for (const FilePolygons& file : files) {
    std::vector<double> x, y;
    for (const Point& place : places) {
      x.push_back(place.x);
      y.push_back(place.y);
    }
    file.markHeld(x, y, held);
  }
  return held;
}

}  // namespace

std::vector<std::uint8_t> trianglesIn(const CutRegion& region, const Grid& grid, std::vector<std::string>& warnings,
                                      const ItemLoop& loop) {
  std::optional<Box> box;
  if (region.box) box = boxOf(region, grid.crs);
  const std::vector<FilePolygons> within = polygonsOfFiles(region.within, grid.crs, warnings);
  const std::vector<FilePolygons> outside = polygonsOfFiles(region.outside, grid.crs, warnings);
  const auto inBox = [&](const Point& p) {
    if (!box || isIn(*box, p)) return true;
    return grid.crs.geographic && (isIn(*box, {p.x - kTurn, p.y}) || isIn(*box, {p.x + kTurn, p.y}));
  };
  std::vector<std::uint8_t> taken(grid.triangles.size(), 0);
  forStretches(loop, grid.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> triangles;
    std::vector<Point> middles;
    for (auto t = static_cast<std::uint32_t>(first); t < last; ++t) {
      const Point middle = middleOf(grid, t);
      if (!inBox(middle)) continue;
      triangles.push_back(t);
      middles.push_back(middle);
    }
    const std::vector<std::uint8_t> in = heldPlaces(within, middles), out = heldPlaces(outside, middles);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      taken[triangles[i]] = (within.empty() || in[i] != 0) && out[i] == 0 ? 1 : 0;
  });
  return taken;
}

}  // namespace coastmesh
