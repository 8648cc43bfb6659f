#include "gis/grid/geographic_nodes.hpp"

#include <algorithm>

#include "gis/crs/geographic_map.hpp"
#include "gis/error.hpp"

namespace coastmesh {

std::vector<Point> geographicNodes(const Grid& grid) {
  const GeographicMap map(grid.crs);
  std::vector<Point> places(grid.nodes.size());
  std::ranges::transform(grid.nodes, places.begin(), [&](const Point& p) { return asGeographic(map.forward(p)); });
  return places;
}

std::vector<Point> requireGeographicNodes(const Grid& grid, const std::string& path, const std::string& model) {
  if (grid.crs.isPlane())
    throw OutputError("cannot write '" + path + "': " + model +
                      " takes longitudes and latitudes, and the mesh lies in a plane; say its CRS with --crs");
  return geographicNodes(grid);
}

}  // namespace coastmesh
