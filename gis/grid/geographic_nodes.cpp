#include "gis/grid/geographic_nodes.hpp"

#include "gis/crs/crs.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"

namespace coastmesh {

std::vector<Point> geographicNodes(const Grid& grid, const ItemLoop& loop) {
  if (sameCrs(grid.crs, wgs84())) return {grid.nodes.begin(), grid.nodes.end()};
  const CrsMap map(toOgr(grid.crs), toOgr(wgs84()));
  std::vector<Point> places(grid.nodes.size());
  forEachByStretches(loop, places.size(), [&](std::size_t i) { places[i] = map.forward(grid.nodes[i]); });
  return places;
}

std::vector<Point> requireGeographicNodes(const Grid& grid, const std::string& path, const std::string& model,
                                          const ItemLoop& loop) {
  if (grid.crs.isPlane())
    throw OutputError("cannot write '" + path + "': " + model +
                      " takes longitudes and latitudes, and the mesh lies in a plane; say its CRS with --crs");
  return geographicNodes(grid, loop);
}

}  // namespace coastmesh
