#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/model/boundary_rules.hpp"

namespace coastmesh {

struct BoundaryOptions {
  std::vector<std::string> files{};  // vector files whose polygons and lines define boundary types: see BoundaryRules
  std::string column{};              // the column of types; empty: the first named type, role, boundary, ibtype or kind
  // Read before, for several grids or since a stream can be read only once. What the input itself defines comes before
  // `files`.
  BoundaryRules of_input{};
  std::optional<std::vector<BoundaryRules>> of_files{};  // those of `files`, each; none: they are read when needed
  double open_deeper_m = std::numeric_limits<double>::infinity();  // metres: edges of outer loops are open if both
                                                                   // ends are deeper, unless a file says otherwise
  double least_length_m = 0.0;  // metres: a boundary shorter than this is merged into the longer one beside it

  bool any() const {
    return !files.empty() || !column.empty() || !of_input.empty() || open_deeper_m < 1e300 || least_length_m > 0.0;
  }
};

struct BoundaryReport {
  std::size_t edges_by_file = 0;   // edges of the boundary, by a file
  std::size_t edges_by_depth = 0;  // edges opened by their depth
  std::size_t merged = 0;          // boundaries that were too short
  std::vector<std::string> warnings;
};

// Reads `options.files`. Throws InputError.
std::vector<BoundaryRules> readBoundaryFiles(const BoundaryOptions& options);

// Changes the grid's boundaries as the options say. Throws InputError.
BoundaryReport assignBoundaries(Grid& grid, const BoundaryOptions& options);

}  // namespace coastmesh
