#pragma once

#include <string_view>
#include <vector>

#include "gis/grid/grid_parts.hpp"

namespace coastmesh {

// Which coordinates a format's files have.
enum class NodePlaces {
  AsTheyAre,   // those of the grid, bit for bit
  Geographic,  // longitudes and latitudes in degrees, bit for bit where the grid has these
  Sphere,  // angles in radians or a sphere's three coordinates, which rounding changes, where the grid is geographic
};

// A file format by its name ("gpkg") and the endings that choose it.
struct GridFormat {
  std::string_view name;
  std::vector<std::string_view> endings;  // none: only the name chooses it
  std::string_view description;
  bool readable = false;
  bool writable = false;
  GridParts holds;          // what its files hold of a grid, and its reader takes back
  bool says_depth = false;  // every file of it has a depth at each node: 0 where the grid has none
  NodePlaces places = NodePlaces::AsTheyAre;
  bool beside_grid = false;  // no grid, but what a solver is given beside one: the parts that `holds` names
};

}  // namespace coastmesh
