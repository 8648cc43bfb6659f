#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Moves nodes that lie past the box of a frame onto it: a parallel is made of straight pieces of the working plane,
// which bulge towards the pole where elements are large. Areas and angles of their triangles are measured again. Does
// nothing where the frame is no box; across the end of the longitudes' turn only latitudes are looked at. A node whose
// move would turn a triangle over stays.
struct FrameMoves {
  std::size_t nodes = 0;                  // that moved
  std::vector<std::uint32_t> fell_short;  // triangles whose smallest angle that brought below the one asked, in degrees
};
FrameMoves keepInFrame(Grid& grid, const Coastline& coastline, double min_angle_deg, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
