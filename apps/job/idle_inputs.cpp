#include "apps/job/idle_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/grid_lines.hpp"

namespace coastmesh {

namespace {

bool coversAny(const RasterGeometry& raster, const Grid& grid) {
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
  for (const Ring& ring : part.rings)
    for (const Point& p : ring) box.add(p);
  for (const auto& line : part.lines)
    for (const Point& p : line) box.add(p);
  return box;
}

// Sizes grow from features outside of the mesh into it, so that what lies a little beside it may well be meant.
bool liesNear(const SizedFeatures& features, const Grid& grid) {
  Box mesh;
  for (const Point& node : grid.nodes) mesh.add(node);
  mesh = mesh.grownBy(0.5 * std::max(mesh.xmax - mesh.xmin, mesh.ymax - mesh.ymin));
  return std::ranges::any_of(features.parts, [&](const SizedFeatures::Part& part) {
    const Box box = boxOf(part);
    if (box.ymax < mesh.ymin || box.ymin > mesh.ymax) return false;
    for (const double turn : {0.0, -360.0, 360.0}) {
      if (box.xmax + turn >= mesh.xmin && box.xmin + turn <= mesh.xmax) return true;
      if (!grid.crs.geographic) break;
    }
    return false;
  });
}

}  // namespace

std::vector<std::string> warningsOfIdleInputs(const MeshJob& job, const SizeInputs& sizes, const Grid& grid) {
  std::vector<std::string> all;
  if (grid.triangles.empty()) return all;
  for (const RasterGeometry& raster : sizes.rasters)
    if (!coversAny(raster, grid))
      all.push_back("--size-raster " + raster.path + ": no node of the mesh lies in it; is its CRS right?");
  for (std::size_t file = 0; file < sizes.features.size(); ++file)
    if (!liesNear(sizes.features[file], grid))
      all.push_back("--size-features " + job.sizes.features[file] +
                    ": none of them lies in the mesh, or near it; is its CRS right?");
  const bool has_weirs = std::ranges::any_of(grid.lines, [](const GridLine& l) { return l.kind == LineKind::Weir; });
  if (!job.input.weirs.empty() && !has_weirs)
    all.push_back("--weirs " + job.input.weirs.front() +
                  (job.input.weirs.size() > 1 ? " and " + std::to_string(job.input.weirs.size() - 1) + " more" : "") +
                  ": no line of it lies in the water");
  return all;
}

}  // namespace coastmesh
