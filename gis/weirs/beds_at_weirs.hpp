#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

struct WeirBeds {
  std::size_t lowered = 0;  // nodes
  Point first;

  std::vector<std::string> notes() const;
};

// ADCIRC stops if the bed at a weir's nodes is not below its crest, as where rasters hold the levee itself. Such nodes
// get the mean bed of the nodes beside them that are no weir's, but at least 0.1 m less than the crest. Unknown beds
// stay.
WeirBeds lowerBedsAtWeirs(Grid& grid);

}  // namespace coastmesh
