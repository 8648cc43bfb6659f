#pragma once

#include <cstddef>
#include <vector>

#include "core/point.hpp"
#include "gis/rivers/river_course.hpp"

namespace coastmesh {

// Rows of quadrilaterals along a reach. Nodes are row after row in its direction, each from the right to the left bank.
struct RiverRows {
  std::size_t cells = 0;  // across
  std::vector<RiverSection> sections;
  std::vector<Point> nodes;  // `cells` + 1 for each section

  const Point& node(std::size_t row, std::size_t i) const { return nodes[row * (cells + 1) + i]; }
};

// Rows between two places of a course, `aspect` times as long as a cell is wide, or shorter in bends. Rows that would
// fold are left out. Empty if no row is left that does not.
// REQUIRES: 0 <= `from` < `to` <= the course's length; cells and `aspect` above 0.
RiverRows riverRows(const RiverCourse& course, double from, double to, std::size_t cells, double aspect);

}  // namespace coastmesh
