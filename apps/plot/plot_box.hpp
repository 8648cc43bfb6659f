#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// West, south, east, north in the grid's CRS. In degrees, west and east may be beyond 180.
using PlotBox = std::array<double, 4>;

// The triangles that a picture of this box may show: those near it, since the box's sides are curves in the plane of
// the picture, which reaches further at its corners. None if no triangle touches the box itself; all if there is no
// box.
std::vector<std::uint32_t> trianglesIn(const Grid& grid, const std::optional<PlotBox>& box);

}  // namespace coastmesh
