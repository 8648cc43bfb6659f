#pragma once

#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"
#include "gis/weirs/raster_crests.hpp"
#include "gis/weirs/weir_crests.hpp"
#include "gis/weirs/weir_report.hpp"

namespace coastmesh {

// Makes boundaries of type 24 of the lines that are weirs and have a height, or a crest in rasters: nodes inside a line
// are divided, those of the front lie to the left of the line as the input has it. Both have the values of the node
// before, and lie a little apart (`moveApart`). The ends of a line are shared; the edges beside them, and where three
// or more weirs meet, are land. On a shore, a line ends with a pair, and the shore's boundary is cut there. Lines that
// run on into one another are one boundary, with the higher crest at the node where they meet, or the lower one if both
// are of rasters. Lines that cannot be opened stay as they are, with a warning. Other boundaries are reassembled;
// islands come after those on the outer shore, weirs last, as ADCIRC wants them. Angles and areas are measured again.
// REQUIRES: no boundary is a weir.
WeirReport openWeirs(Grid& grid, const std::vector<WeirSource>& sources, double min_angle_deg,
                     const ItemLoop& loop = inOrder, const RasterCrests& rasters = {});

}  // namespace coastmesh
