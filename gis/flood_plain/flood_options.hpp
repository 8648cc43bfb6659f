#pragma once

#include <limits>
#include <optional>

#include "gis/model/depth.hpp"

namespace coastmesh {

// The land that is meshed besides the water.
struct FloodOptions {
  std::optional<double> height_m{};  // metres above the still water, above 0: land below it is meshed; nullopt: none
  DepthOptions heights{};            // the rasters, their sign, and the level of the still water
  // Metres: elements at shores are about as long. Cells of heights are at most a third of it, unless pixels are larger.
  double size_m = std::numeric_limits<double>::infinity();
};

}  // namespace coastmesh
