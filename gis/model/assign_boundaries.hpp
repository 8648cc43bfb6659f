#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

struct BoundaryOptions {
  // Vector files whose polygons and lines say what the boundary is: each edge whose middle lies in a polygon, or that
  // runs along a line (no point of it further off than a fifth of its length), is of the type that the feature's column
  // says. Where several do, the last counts. Polygons open no islands; lines do.
  std::vector<std::string> files;
  std::string column;  // the column of types; empty: the first called type, role, boundary, ibtype or kind
  // The same for files whose features may lack the column: the input itself. One that `coastmesh clean` wrote with
  // types of its boundary says these, whatever the column.
  std::vector<std::string> inputs;
  double open_deeper_m = std::numeric_limits<double>::infinity();  // metres: edges of outer loops are open where both
                                                                   // ends are deeper, unless a file says otherwise
  double least_length_m = 0.0;  // metres: a boundary shorter than this becomes part of the longer one beside it

  bool any() const { return !files.empty() || !inputs.empty() || open_deeper_m < 1e300 || least_length_m > 0.0; }
};

struct BoundaryReport {
  std::size_t edges_by_file = 0;   // of the boundary, by a file
  std::size_t edges_by_depth = 0;  // opened by their depth
  std::size_t merged = 0;          // boundaries that were too short
  std::vector<std::string> warnings;
};

// What a column's text means: land (shore, coast, wall, closed, solid, mainland, island), open (ocean, sea, tidal,
// level) and river (inflow, discharge, flow), in capitals or not, or a number: ADCIRC's IBTYPE, -1 being open. Throws
// InputError with `what` at its start.
BoundaryKind kindOfText(const std::string& text, const std::string& what);

// What the columns of `inputs` say of edges of the boundary, as `kindOfText` takes it; empty where they say nothing.
// `edges` are pairs of `places`, which are in `crs`. Throws InputError.
std::vector<std::string> boundaryTexts(const Crs& crs, const std::vector<Point>& places,
                                       const std::vector<NodePair>& edges, const std::vector<std::string>& inputs,
                                       const std::string& column);

// Sets the grid's boundaries anew by the options, on top of what they were. Throws InputError.
BoundaryReport assignBoundaries(Grid& grid, const BoundaryOptions& options);

}  // namespace coastmesh
