#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Nodes deeper or higher, in metres, than any place on Earth: probably no-data values that are not declared.
struct ImpossibleDepths {
  std::size_t nodes = 0;
  std::size_t worst = 0;  // the index of the most extreme node
};

// Returns nullopt if there are none.
std::optional<ImpossibleDepths> impossibleDepths(const Grid& grid);

// "3 of 40 nodes have depths that do not occur on Earth, such as 99999 m at (…)".
std::string textOf(const ImpossibleDepths& found, const Grid& grid);

}  // namespace coastmesh
