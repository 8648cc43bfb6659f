#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "gis/crs/crs.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Land for a closed loop of the boundary that goes counter-clockwise, else an island. REQUIRES: the mesh lies to the
// loop's left; a node that the loop passes twice is allowed. In longitudes and latitudes ±180 and whole revolutions do
// not matter; a loop that is large, goes round a pole or comes near one is land where less than half the globe lies to
// its left. A sea that has no outer shore has islands only.
BoundaryRole roleOfLoop(std::span<const Point> nodes, std::span<const std::uint32_t> loop, const Crs& crs);

// The same for loops that are large, or whose direction is not plain in degrees; none for all others.
std::optional<BoundaryRole> roleByArea(std::span<const Point> nodes, std::span<const std::uint32_t> loop,
                                       const Crs& crs);

}  // namespace coastmesh
