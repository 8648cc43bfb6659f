#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

struct WeirBeds {
  std::size_t lowered = 0, raised = 0;  // nodes; pairs
  Point first_lowered, first_raised;

  std::vector<std::string> notes() const;
};

// ADCIRC stops if the bed at a weir's node is higher than its crest. Where rasters hold the levee itself, such nodes
// get the mean bed of the nodes beside them that are no weir's, if that is below the crest. Where the ground there is
// as high, water has to pass that instead of the crest: the crest is raised to 0.1 m above the bed. Unknown beds stay.
WeirBeds fitWeirsToBeds(Grid& grid);

}  // namespace coastmesh
