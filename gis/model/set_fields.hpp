#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/fields/field_source.hpp"
#include "gis/grid/grid.hpp"
#include "gis/model/depth.hpp"

namespace coastmesh {

// What was made of one nodal attribute.
struct FieldReport {
  std::string name;
  std::vector<FieldSource> rasters;
  std::vector<std::size_t> nodes_of_file;  // for each raster: nodes that took their value from it
  std::size_t averaged = 0;                // of these, by the mean over their triangles
  std::size_t of_number = 0;               // nodes that got the attribute's number
  std::size_t kept = 0;                    // nodes without either that kept the value that they had
  std::size_t filled = 0;                  // nodes without any, filled from others
  std::size_t unknown = 0;
  double least = 0.0, greatest = 0.0;
  std::vector<std::string> notes, warnings;
};

// Sets nodal attributes of a grid, in the order in which they are named first: of the first raster that has a value at
// a node, by `method`, or by classes; else their number, else what the grid has, else as `fill` says. Values that are
// computed have seven digits. States (`isState`) are those of the nearest pixel or node. Throws InputError, Cancelled.
std::vector<FieldReport> setFields(Grid& grid, const std::vector<FieldSource>& sources, DepthMethod method,
                                   DepthFill fill, const RunControl& control = {}, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
