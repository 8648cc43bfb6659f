#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Moves nodes outside the box of a frame onto it: a parallel consists of straight pieces in the working plane, which
// bulge towards the pole if elements are large. Areas and angles of their triangles are computed again. Does nothing if
// the frame is not a box; if it crosses the end of the longitudes, only latitudes are clamped. A node whose move would
// invert a triangle stays.
struct FrameMoves {
  std::size_t nodes = 0;                  // moved nodes
  std::vector<std::uint32_t> fell_short;  // triangles whose smallest angle is now below `min_angle_deg`
};
FrameMoves keepInFrame(Grid& grid, const Coastline& coastline, double min_angle_deg, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
