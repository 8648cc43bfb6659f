#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/cut/cut_region.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// `trianglesIn` the region. `purpose`: "to cut out". Throws InputError, also if there are none, with the name and the
// extent of the mesh.
std::vector<std::uint8_t> requireTriangles(const CutRegion& region, const Grid& grid, const std::string& name,
                                           const std::string& purpose, std::vector<std::string>& warnings,
                                           const ItemLoop& loop);

}  // namespace coastmesh
