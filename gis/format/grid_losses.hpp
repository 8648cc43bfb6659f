#pragma once

#include <string>

#include "gis/format/grid_io.hpp"

namespace coastmesh {

// Which losses are reported.
enum class LossesOf {
  Grid,   // everything that the grid holds
  Input,  // what the user gave: lines, regions, types of boundaries, and pieces, which are marked on request
};

// Describes what a file of the format cannot hold of the grid, as the end of a sentence: "the names of 2 regions; 2
// weirs, whose edges stay in the mesh". Empty if it can hold everything.
std::string lossesIn(const Grid& grid, const GridFormat& format, LossesOf of);

// Warnings about numbers that models would misread in `path`; empty if there are none. For a format with `says_depth`:
// a depth of 0 at each node of a grid without depths. For one with `lengths_in_metres`: coordinates in other units, or
// not true to scale.
std::string depthWarning(const Grid& grid, const std::string& path);
std::string metreWarning(const Grid& grid, const std::string& path);

}  // namespace coastmesh
