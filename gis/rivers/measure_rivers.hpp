#pragma once

#include <cstddef>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/crs/crs.hpp"
#include "gis/rivers/river_banks.hpp"
#include "gis/rivers/river_lines.hpp"

namespace coastmesh {

// Lines as wide as the water between the banks.
struct MeasuredRivers {
  std::vector<RiverLine> lines;                    // in parts of alike widths, in the direction of the line
  double length_m = 0.0, measured_m = 0.0;         // of all lines, and of what of them is between banks
  double least_width_m = 0.0, most_width_m = 0.0;  // between banks; 0 if nothing of any line is
  std::size_t without = 0;                         // lines that have no part between banks
};

// Lines get the width from bank to bank across them, and move to the middle. Widths change along a line by at most half
// the distance, so that the mouth of a tributary, or a bay, widens nothing. Beyond the banks a line has its own width,
// else that where it leaves them. `crs`: of lines, banks and mesh. Throws InputError for a line that has neither, and
// for one that cannot be projected.
MeasuredRivers measureRivers(std::vector<RiverLine> lines, const RiverBanks& banks, const Crs& crs,
                             const ItemLoop& loop = inOrder);

}  // namespace coastmesh
