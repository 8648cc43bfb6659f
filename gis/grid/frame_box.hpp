#pragma once

#include <cstddef>

#include "core/item_loop.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Moves nodes that lie past the box of a frame onto it: a parallel is made of straight pieces of the working plane,
// which bulge towards the pole where elements are large. Areas and angles of their triangles are measured again. Does
// nothing where the frame is no box; across the end of the longitudes' turn only latitudes are looked at. A node whose
// move would turn a triangle over stays. Returns how many moved.
std::size_t keepInFrame(Grid& grid, const Coastline& coastline, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
