#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Nodes that are deeper or higher, in metres, than any place on Earth: numbers that stand for no value, which whoever
// wrote them did not say.
struct ImpossibleDepths {
  std::size_t nodes = 0;
  std::size_t worst = 0;  // a node
};

// Nothing where there are none.
std::optional<ImpossibleDepths> impossibleDepths(const Grid& grid);

// "3 of 40 nodes have depths that do not occur on Earth, such as 99999 m at (…)".
std::string textOf(const ImpossibleDepths& found, const Grid& grid);

}  // namespace coastmesh
