#pragma once

#include <string_view>
#include <vector>

#include "gis/grid/grid_parts.hpp"

namespace coastmesh {

// The type of coordinates in a format's files.
enum class NodePlaces {
  AsTheyAre,   // those of the grid, bit for bit
  OneTurn,     // the same, but longitudes do not jump unless the mesh surrounds a pole or the globe (`inOneTurn`)
  Geographic,  // longitudes and latitudes in degrees, bit for bit if the grid has these
  Sphere,      // angles in radians or coordinates on a sphere, subject to rounding, if the grid is geographic
};

// The boundaries whose nodes a format's files mark: a shore's edge between two marked nodes opens.
enum class MarkedNodes { None, OfOpen, OfOpenAndRivers };

// A file format, its name ("gpkg") and its file endings.
struct GridFormat {
  std::string_view name;
  std::vector<std::string_view> endings;  // none: chosen by name only
  std::string_view description;
  bool readable = false;
  bool writable = false;
  GridParts holds{};          // the parts of a grid that its files hold and its reader restores
  bool says_depth = false;    // its files have a depth at each node: 0 if the grid has none
  bool needs_depths = false;  // of a grid with depths, all nodes need one: writing fails if one has none
  NodePlaces places = NodePlaces::AsTheyAre;
  // Read by models that take lengths to be in metres; the files do not hold the unit.
  bool lengths_in_metres = false;
  bool beside_grid = false;  // not a grid, but an additional file for a solver, with the parts in `holds`
  MarkedNodes marked = MarkedNodes::None;
  bool holds_esri_wkt = false;  // its files hold the CRS as a .prj does
  bool of_water = false;        // has depth 0 where the grid has a height above the water
};

}  // namespace coastmesh
