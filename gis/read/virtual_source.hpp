#pragma once

#include <string>
#include <vector>

namespace coastmesh {

// The files that a virtual data set of GDAL (VRT of rasters or layers, in a file or as text, "vrt://…") takes its data
// from, including those of virtual ones among them, without the data set itself. Empty for any other name: a source
// with its own data is not opened.
std::vector<std::string> filesBehind(const std::string& name);

}  // namespace coastmesh
