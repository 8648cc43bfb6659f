#include "apps/edit/edit_part.hpp"

#include <algorithm>

#include "gis/coast/box_of_frame.hpp"
#include "gis/crs/crs.hpp"
#include "gis/error.hpp"

namespace coastmesh {

std::vector<std::uint8_t> requireTriangles(const CutRegion& region, const Grid& grid, const std::string& name,
                                           const std::string& purpose, std::vector<std::string>& warnings,
                                           const ItemLoop& loop) {
  std::vector<std::uint8_t> taken = trianglesIn(region, grid, warnings, loop);
  if (std::ranges::find(taken, 1) == taken.end())
    throw InputError("no triangle of '" + name + "' has its middle in the part " + purpose +
                     "; the mesh extends, as W,S,E,N, over " + inWords(boxAround(grid.nodes, loop)) +
                     (grid.crs.isPlane() ? "" : " (" + nameOf(grid.crs) + ")"));
  return taken;
}

}  // namespace coastmesh
