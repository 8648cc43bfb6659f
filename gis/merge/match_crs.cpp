#include "gis/merge/match_crs.hpp"

#include <cmath>
#include <vector>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

void transform(Grid& grid, const Crs& crs, const std::string& path) {
  std::vector<double> x, y;
  for (const Point& p : grid.nodes) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
  CrsMap(toOgr(grid.crs), toOgr(crs)).forward(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      throw InputError("node " + std::to_string(i + 1) + " of '" + path + "' has no place in " + nameOf(crs));
    grid.nodes[i] = {x[i], y[i]};
  }
  grid.crs = crs;
}

double middleLongitude(const Grid& grid) {
  const Box box = boxAround(grid.nodes, inOrder);
  return 0.5 * (box.xmin + box.xmax);
}

}  // namespace

void matchCrs(Grid& grid, const Grid& beside, const std::string& path) {
  if (grid.crs.isPlane() != beside.crs.isPlane()) {
    const std::string& crs = nameOf(grid.crs.isPlane() ? beside.crs : grid.crs);
    throw InputError("'" + path + "' " +
                     (grid.crs.isPlane() ? "does not say its CRS, and the other mesh is in " + crs
                                         : "is in " + crs + ", and the other mesh does not say its CRS") +
                     ": give --assume-crs");
  }
  if (grid.crs.isPlane()) return;
  if (!sameCrs(grid.crs, beside.crs)) transform(grid, beside.crs, path);
  if (!beside.crs.geographic) return;
  constexpr double kTurn = 360.0;
  const double turns = kTurn * std::round((middleLongitude(beside) - middleLongitude(grid)) / kTurn);
  if (turns == 0.0) return;
  for (Point& p : grid.nodes) p.x += turns;
}

}  // namespace coastmesh
