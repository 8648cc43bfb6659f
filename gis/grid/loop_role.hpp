#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "gis/crs/crs.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Returns Land for a counter-clockwise closed loop of the boundary, otherwise Island. REQUIRES: the mesh is to the
// loop's left; the loop may pass a node twice. In longitudes and latitudes ±180 and full turns do not matter; a loop
// that is large, surrounds a pole or is close to one is land if less than half the globe is to its left. A sea without
// an outer shore has only islands.
BoundaryRole roleOfLoop(std::span<const Point> nodes, std::span<const std::uint32_t> loop, const Crs& crs);

// The same for loops that are large, or whose direction is unclear in degrees; nullopt for all others.
std::optional<BoundaryRole> roleByArea(std::span<const Point> nodes, std::span<const std::uint32_t> loop,
                                       const Crs& crs);

}  // namespace coastmesh
