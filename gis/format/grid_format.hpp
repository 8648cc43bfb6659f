#pragma once

#include <string_view>
#include <vector>

#include "gis/grid/grid_parts.hpp"

namespace coastmesh {

// A file format by its name ("gpkg") and the endings that choose it.
struct GridFormat {
  std::string_view name;
  std::vector<std::string_view> endings;  // none: only the name chooses it
  std::string_view description;
  bool readable = false;
  bool writable = false;
  GridParts holds;          // what its files hold of a grid, and its reader takes back
  bool says_depth = false;  // every file of it has a depth at each node: 0 where the grid has none
};

}  // namespace coastmesh
