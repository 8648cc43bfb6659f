#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

struct BoundaryOptions {
  // Vector files whose polygons and lines define boundary types: an edge whose midpoint is in a polygon, or that runs
  // along a line (entirely within a fifth of its length), gets the type in the feature's column. If there are several,
  // the last applies. Polygons open no islands; lines do.
  std::vector<std::string> files{};
  std::string column{};  // the column of types; empty: the first named type, role, boundary, ibtype or kind
  // The same for files whose features may lack the column: the input itself. A file that `coastmesh clean` wrote with
  // boundary types defines these, for any column.
  std::vector<std::string> inputs{};
  double open_deeper_m = std::numeric_limits<double>::infinity();  // metres: edges of outer loops are open if both
                                                                   // ends are deeper, unless a file says otherwise
  double least_length_m = 0.0;  // metres: a boundary shorter than this is merged into the longer one beside it

  bool any() const { return !files.empty() || !inputs.empty() || open_deeper_m < 1e300 || least_length_m > 0.0; }
};

struct BoundaryReport {
  std::size_t edges_by_file = 0;   // edges of the boundary, by a file
  std::size_t edges_by_depth = 0;  // edges opened by their depth
  std::size_t merged = 0;          // boundaries that were too short
  std::vector<std::string> warnings;
};

// The meaning of a column's text: land (shore, coast, wall, closed, solid, mainland, island), open (ocean, sea, tidal,
// level) and river (inflow, discharge, flow), case-insensitive, or a number: ADCIRC's IBTYPE, -1 for open. Throws
// InputError that starts with `what`.
BoundaryKind kindOfText(const std::string& text, const std::string& what);

// The types in the columns of `inputs` for edges of the boundary, as in `kindOfText`; empty if there are none. `edges`
// are pairs of `places`, which are in `crs`. Throws InputError.
std::vector<std::string> boundaryTexts(const Crs& crs, const std::vector<Point>& places,
                                       const std::vector<NodePair>& edges, const std::vector<std::string>& inputs,
                                       const std::string& column);

// Changes the grid's boundaries as the options say. Throws InputError.
BoundaryReport assignBoundaries(Grid& grid, const BoundaryOptions& options);

}  // namespace coastmesh
