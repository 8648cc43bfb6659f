#pragma once

#include <string>

#include "gis/format/grid_io.hpp"

namespace coastmesh {

// Which losses are reported.
enum class LossesOf {
  Grid,   // all that the grid holds
  Input,  // what the user gave for it: lines, regions, types of boundaries, and pieces, which are marked on request
};

// What of the grid a file of the format cannot hold, as the end of a sentence: "2 weirs, whose edges stay in the mesh;
// the regions of triangles". Empty where it holds all.
std::string lossesIn(const Grid& grid, const GridFormat& format, LossesOf of);

}  // namespace coastmesh
