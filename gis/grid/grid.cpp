#include "gis/grid/grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include "core/bulk_list.hpp"
#include "core/quality.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"

namespace coastmesh {
std::string_view toString(BoundaryRole role) {
  switch (role) {
    case BoundaryRole::Land:
      return "land";
    case BoundaryRole::Island:
      return "island";
    case BoundaryRole::Open:
      return "open";
    case BoundaryRole::River:
      return "river";
  }
  assert(false);
  return {};
}

void requireZ(const Grid& grid, const std::string& path) {
  const auto unknown = std::ranges::find_if(grid.z, [](double z) { return std::isnan(z); });
  if (unknown == grid.z.end()) return;
  const auto node = static_cast<std::size_t>(unknown - grid.z.begin());
  throw OutputError("cannot write '" + path + "': the z of node " + std::to_string(node + 1) + " at " +
                    std::to_string(grid.nodes[node].x) + ", " + std::to_string(grid.nodes[node].y) +
                    " is unknown, and the format cannot say that; choose one that can, such as .nc and .gpkg");
}

TriMesh toTriMesh(const Grid& grid, const Projection& projection, std::vector<EdgeConflict>& conflicts,
                  const ItemLoop& loop) {
  BulkList<Point> points;
  resizeUnset(points, grid.nodes.size());
  forEachByStretches(loop, points.size(),
                     [&](std::size_t node) { points[node] = projection.forward(grid.nodes[node]); });
  TriMesh mesh = linkTriangles(std::move(points), grid.triangles, conflicts, loop);
  if (!grid.feature_of.empty())
    forEachByStretches(loop, mesh.regions.size(),
                       [&](std::size_t t) { mesh.regions[t] = static_cast<RegionId>(grid.feature_of[t]); });
  return mesh;
}

}  // namespace coastmesh
