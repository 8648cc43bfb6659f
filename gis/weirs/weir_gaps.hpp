#pragma once

#include <cstdint>
#include <span>

#include "gis/grid/grid.hpp"
#include "gis/weirs/weir_cuts.hpp"
#include "gis/weirs/weir_report.hpp"

namespace coastmesh {

// Moves the nodes that one node was divided into apart: along the shore if their sector has one, otherwise into the
// middle of their sector. The gap between two is a fiftieth of the shortest edge there, from 0.5 to 10 m, and less than
// a tenth of that edge; smaller where an angle would fall below `min_angle_deg`. No triangle is turned over.
// `nodes`: for each sector of `sectors` the node that its triangles have; all lie at one place.
void moveApart(Grid& grid, std::span<const NodeSector> sectors, std::span<const std::uint32_t> nodes,
               double min_angle_deg, WeirGaps& gaps);

}  // namespace coastmesh
