#pragma once

#include <string>
#include <vector>

namespace coastmesh {

// The files that a virtual data set of GDAL (VRT of rasters, of layers, in a file or as text, "vrt://…") takes its data
// from, those of virtual ones among them too; the data set itself is not one of them. Nothing for any other name: a
// source that holds its own data is not opened.
std::vector<std::string> filesBehind(const std::string& name);

}  // namespace coastmesh
